#include "lamp/core/RunFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "TestSupport.h"
#include "lamp/core/Files.h"

namespace lamp {
namespace {

namespace fs = std::filesystem;
using test::freshFolder;
using test::thrownBy;
using testing::AllOf;
using testing::HasSubstr;

TEST(RunFolder, IsMadeWithItsParentsAndSubfolders) {
  const std::string root = freshFolder() + "/deep/run";
  const RunFolder folder = RunFolder::create(root);
  EXPECT_EQ(folder.root(), root);
  EXPECT_TRUE(fs::is_empty(root)) << "an early failure must leave a folder that can be used again";
  folder.createSubfolders();
  for (const char* sub : {"trajectories", "keyframes", "maps"})
    EXPECT_TRUE(fs::is_directory(fs::path(root) / sub)) << sub;
}

TEST(RunFolder, MayBeThereAlreadyIfEmpty) {
  const std::string root = freshFolder();
  EXPECT_NO_THROW(RunFolder::create(root));
}

TEST(RunFolder, IsNotWrittenOver) {
  const std::string root = freshFolder();
  writeTextFile(root + "/precious", "x");
  EXPECT_THAT(thrownBy([&] { RunFolder::create(root); }),
              AllOf(HasSubstr("'" + root + "'"), HasSubstr("holds files already")));
  EXPECT_FALSE(fs::exists(root + "/maps"));
}

TEST(RunFolder, IsLockedWhileItOrACopyLives) {
  const std::string root = freshFolder();
  {
    RunFolder copy("");
    {
      const RunFolder folder = RunFolder::create(root);
      copy = folder;
    }
    EXPECT_THAT(thrownBy([&] { RunFolder::create(root); }),
                AllOf(HasSubstr("'" + root + "'"), HasSubstr("another program")));
    EXPECT_TRUE(fs::is_empty(root));
  }
  EXPECT_NO_THROW(RunFolder::create(root));
}

TEST(RunFolder, IsNoFile) {
  const std::string path = freshFolder() + "/file";
  writeTextFile(path, "x");
  EXPECT_THAT(thrownBy([&] { RunFolder::create(path); }),
              AllOf(HasSubstr("'" + path + "'"), HasSubstr("is a file")));
}

TEST(RunFolder, BelowAFileOrInProcCannotBeWritten) {
  const std::string file = freshFolder() + "/file";
  writeTextFile(file, "x");
  EXPECT_THAT(thrownBy([&] { RunFolder::create(file + "/run"); }),
              AllOf(HasSubstr("'" + file + "/run'"), HasSubstr("cannot be written: ")));
  EXPECT_THAT(thrownBy([] { RunFolder::create("/proc/run"); }), HasSubstr("cannot be written: "));
}

TEST(RunFolder, WithoutPermissionCannotBeWritten) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const std::string parent = freshFolder();
  fs::permissions(parent, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THAT(thrownBy([&] { RunFolder::create(parent + "/run"); }),
              HasSubstr("cannot be written"));
  EXPECT_THAT(thrownBy([&] { RunFolder::create(parent); }), HasSubstr("cannot be written"));
  fs::permissions(parent, fs::perms::owner_all);
}

TEST(RunFolder, PathsAreThoseOfTheDocumentation) {
  const RunFolder run("out");
  EXPECT_EQ(run.loops(), "out/loops.csv");
  EXPECT_EQ(run.trajectory("husky1"), "out/trajectories/husky1.tum");
  EXPECT_EQ(run.keyNodeTrajectory("husky1"), "out/trajectories/husky1.keyframes.tum");
  EXPECT_EQ(run.odometryTrajectory("husky1"), "out/trajectories/husky1.odometry.tum");
  EXPECT_EQ(run.keyNodes("husky1"), "out/keyframes/husky1.rawlog");
  EXPECT_EQ(run.mapStem(0), "out/maps/map");
  EXPECT_EQ(run.mapStem(1), "out/maps/map_2");
}

}  // namespace
}  // namespace lamp
