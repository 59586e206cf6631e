#include "lamp/core/Files.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <future>

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

TEST(Files, ThroughALinkTheFileThatItNamesIsWritten) {
  const std::string folder = freshFolder(), target = folder + "/elsewhere/t.txt";
  std::filesystem::create_directory(folder + "/elsewhere");
  std::filesystem::create_symlink("elsewhere/t.txt", folder + "/link");
  std::filesystem::create_symlink("link", folder + "/link_to_link");
  writeTextFile(folder + "/link_to_link", "first, through a link to nothing");
  EXPECT_EQ(readTextFile(target), "first, through a link to nothing");
  writeTextFile(folder + "/link", "second");
  EXPECT_EQ(readTextFile(target), "second");
  EXPECT_TRUE(std::filesystem::is_symlink(folder + "/link"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder + "/link_to_link"));
  EXPECT_EQ(filesIn(folder + "/elsewhere"), 1u);
}

TEST(Files, APipeIsWrittenToAndStaysOne) {
  const std::string folder = freshFolder(), path = folder + "/pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  auto read = std::async(std::launch::async, [&] {
    std::ifstream pipe(path);
    return std::string(std::istreambuf_iterator<char>(pipe), {});
  });
  writeTextFile(path, "through the pipe");
  EXPECT_EQ(read.get(), "through the pipe");
  EXPECT_TRUE(std::filesystem::is_fifo(path));
  EXPECT_EQ(filesIn(folder), 1u);
}

TEST(Files, ADeviceStaysOneAndSaysThatItIsFull) {
  EXPECT_THAT(thrownBy([] { writeTextFile("/dev/full", "x"); }),
              testing::AllOf(HasSubstr("'/dev/full'"), HasSubstr("No space left")));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

/** As `> FILE` and /dev/stdout have it: whoever opened the file keeps the one that is written. */
TEST(Files, AnOpenFileIsWrittenInPlace) {
  const std::string path = freshFolder() + "/t.txt";
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT, 0600);
  writeTextFile("/dev/fd/" + std::to_string(file), "seen by both");
  EXPECT_EQ(readTextFile(path), "seen by both");
  char byte = 0;
  EXPECT_EQ(::read(file, &byte, 1), 1);
  EXPECT_EQ(byte, 's');
  ::close(file);
}

TEST(FilesDeathTest, NothingIsLeftWhenASignalEndsTheProgram) {
  const std::string folder = freshFolder(), path = folder + "/t.txt";
  const auto dieWithin = [&] {
    writeAtomically(path, [](const std::string& temporary) {
      std::ofstream(temporary) << "half";
      removeUnfinishedFiles();
      std::raise(SIGKILL);
    });
  };
  EXPECT_EXIT(dieWithin(), testing::KilledBySignal(SIGKILL), "");
  EXPECT_EQ(filesIn(folder), 0u);
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
              testing::AllOf(HasSubstr(folder), HasSubstr("not a readable file")));
}

}  // namespace
}  // namespace lamp
