#include "lamp/core/Files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "TestSupport.h"

namespace lamp {
namespace {

using test::freshFolder;
using test::thrownBy;
using testing::HasSubstr;

size_t filesIn(const std::string& folder) {
  const std::filesystem::directory_iterator entries(folder);
  return static_cast<size_t>(std::distance(begin(entries), end(entries)));
}

TEST(Files, TextReadsBackByteForByte) {
  const std::string path = freshFolder() + "/t.txt";
  const std::string text("a\r\n\0b\n", 6);
  writeTextFile(path, text);
  EXPECT_EQ(readTextFile(path), text);
  writeTextFile(path, "");
  EXPECT_EQ(readTextFile(path), "");
}

TEST(Files, TheOldFileStaysUntilTheNewOneIsComplete) {
  const std::string folder = freshFolder(), path = folder + "/t.txt";
  writeTextFile(path, "old");
  writeAtomically(path, [&](const std::string& temporary) {
    EXPECT_EQ(std::filesystem::path(temporary).parent_path(), folder);
    std::ofstream(temporary) << "new";
    EXPECT_EQ(readTextFile(path), "old");
  });
  EXPECT_EQ(readTextFile(path), "new");
  EXPECT_EQ(filesIn(folder), 1u);
}

TEST(Files, NothingIsLeftWhenTheWriterThrows) {
  const std::string folder = freshFolder(), path = folder + "/t.txt";
  const auto write = [&] {
    writeAtomically(path, [](const std::string& temporary) {
      std::ofstream(temporary) << "half";
      throw std::runtime_error("the writer's own words");
    });
  };
  EXPECT_EQ(thrownBy(write), "the writer's own words");
  EXPECT_EQ(filesIn(folder), 0u);
}

TEST(Files, NothingIsLeftWhenTheTargetIsAFolder) {
  const std::string folder = freshFolder(), path = folder + "/taken";
  std::filesystem::create_directories(path + "/sub");
  EXPECT_THAT(thrownBy([&] { writeTextFile(path, "x"); }), HasSubstr("'" + path + "'"));
  EXPECT_EQ(filesIn(folder), 1u);
}

TEST(Files, MissingFolderIsNamed) {
  const std::string path = freshFolder() + "/missing/t.txt";
  EXPECT_THAT(thrownBy([&] { writeTextFile(path, "x"); }),
              testing::AllOf(HasSubstr("'" + path + "'"), HasSubstr("No such file")));
}

TEST(Files, ReadingNamesWhatIsMissingOrNoFile) {
  const std::string folder = freshFolder();
  EXPECT_THAT(thrownBy([&] { readTextFile(folder + "/none"); }),
              testing::AllOf(HasSubstr(folder + "/none"), HasSubstr("no such file")));
  EXPECT_THAT(thrownBy([&] { readTextFile(folder); }),
              testing::AllOf(HasSubstr(folder), HasSubstr("no readable file")));
}

}  // namespace
}  // namespace lamp
