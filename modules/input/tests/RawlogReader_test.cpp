#include "lamp/input/RawlogReader.h"

#include <gmock/gmock.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <sys/resource.h>

#include "RecordingTools.h"

namespace lamp {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;

/** Stamps of the observations that a reader gives; frames count with the stamp of each part. */
std::vector<double> stampsIn(RawlogReader& reader) {
  std::vector<double> stamps;
  while (const auto object = reader.next()) {
    if (const auto o = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object)) {
      stamps.push_back(mrpt::Clock::toDouble(o->timestamp));
    }
    if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object)) {
      for (const auto& o : *frame) stamps.push_back(mrpt::Clock::toDouble(o->timestamp));
    }
  }
  return stamps;
}

std::string errorOf(const std::string& path) {
  try {
    RawlogReader reader(path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

Objects threeObservations() {
  return {cloud(1, "lidar"), cloud(2, "lidar"), cloud(3, "lidar")};
}

TEST(RawlogReader, ReadsPlainAndGzippedFiles) {
  const std::string folder = freshFolder(), bytes = bytesOf(threeObservations());
  writeFile(folder + "/plain.rawlog", bytes);
  writeGzFile(folder + "/gz.rawlog", bytes);
  for (const char* name : {"/plain.rawlog", "/gz.rawlog"}) {
    RawlogReader reader(folder + name);
    EXPECT_THAT(stampsIn(reader), ElementsAre(1, 2, 3)) << name;
    EXPECT_EQ(reader.report().objects, 3u);
    EXPECT_EQ(reader.report().bytes_skipped, 0u);
    EXPECT_FALSE(reader.report().truncated);
    EXPECT_TRUE(reader.report().messages.empty());
    EXPECT_EQ(reader.progress(), 1.0);
    EXPECT_EQ(reader.next(), nullptr);
  }
}

TEST(RawlogReader, NamesMissingFile) {
  EXPECT_THAT(errorOf("/no/such/robot.rawlog"), HasSubstr("/no/such/robot.rawlog: no such file"));
}

TEST(RawlogReader, NamesFolderAndEmptyFile) {
  const std::string folder = freshFolder();
  EXPECT_THAT(errorOf(folder), HasSubstr("not a file"));
  writeFile(folder + "/empty.rawlog", "");
  EXPECT_THAT(errorOf(folder + "/empty.rawlog"), HasSubstr("empty.rawlog: the file is empty"));
}

TEST(RawlogReader, RefusesText) {
  const std::string folder = freshFolder();
  writeFile(folder + "/text.rawlog", "# stamp x y z\n1 2 3 4\n");
  EXPECT_THAT(errorOf(folder + "/text.rawlog"), HasSubstr("text.rawlog: not an MRPT rawlog"));
  writeGzFile(folder + "/text_gz.rawlog", std::string(300000, 'a'));
  EXPECT_THAT(errorOf(folder + "/text_gz.rawlog"), HasSubstr("not an MRPT rawlog"));
}

TEST(RawlogReader, RefusesFileThatCannotBeDecompressed) {
  const std::string folder = freshFolder();
  writeGzFile(folder + "/whole.rawlog", bytesOf(threeObservations()));
  writeFile(folder + "/cut.rawlog", readFile(folder + "/whole.rawlog").substr(0, 11));
  EXPECT_THAT(errorOf(folder + "/cut.rawlog"), HasSubstr("cut.rawlog: "));
}

TEST(RawlogReader, UsesWhatIsThereOfACutPlainFile) {
  const std::string path = freshFolder() + "/cut.rawlog";
  const std::string bytes = bytesOf(threeObservations());
  const size_t third = bytes.size() / 3;
  // Within the third object's data, and within its header.
  for (const size_t size : {2 * third + third / 2, 2 * third + 5}) {
    writeFile(path, bytes.substr(0, size));
    RawlogReader reader(path);
    EXPECT_THAT(stampsIn(reader), ElementsAre(1, 2)) << size;
    EXPECT_TRUE(reader.report().truncated) << size;
    EXPECT_EQ(reader.report().bytes_skipped, size - 2 * third);
    EXPECT_THAT(reader.report().messages, ElementsAre(HasSubstr("cut off")));
  }
}

TEST(RawlogReader, UsesWhatIsThereOfACutGzFile) {
  const std::string folder = freshFolder();
  Objects many;
  std::srand(1);
  for (int i = 0; i < 200; ++i) {
    auto o = cloud(1 + i, "lidar", 0);
    for (int k = 0; k < 300; ++k) {
      o->pointcloud->insertPoint(static_cast<float>(std::rand()), static_cast<float>(std::rand()),
                                 0);
    }
    many.push_back(o);
  }
  writeGzFile(folder + "/whole.rawlog", bytesOf(many));
  const std::string whole = readFile(folder + "/whole.rawlog");
  writeFile(folder + "/cut.rawlog", whole.substr(0, whole.size() / 2));
  RawlogReader reader(folder + "/cut.rawlog");
  const size_t read = stampsIn(reader).size();
  EXPECT_GT(read, 90u);
  EXPECT_LT(read, 101u);
  EXPECT_TRUE(reader.report().truncated);
  EXPECT_THAT(reader.report().messages, testing::Contains(HasSubstr("compressed file is cut off")));
}

TEST(RawlogReader, SkipsAndCountsUnknownClasses) {
  const std::string path = freshFolder() + "/foreign.rawlog";
  const std::string foreign = foreignObject("vendor::CObservationThermal", std::string(5000, 'x'));
  writeFile(path, bytesOf(*cloud(1, "lidar")) + foreign + foreign + bytesOf(*cloud(2, "lidar")) +
                      foreignObject("CObservationOdd", "abc") + bytesOf(*cloud(3, "lidar")));
  RawlogReader reader(path);
  EXPECT_THAT(stampsIn(reader), ElementsAre(1, 2, 3));
  const auto& report = reader.report();
  EXPECT_THAT(report.unknown_classes, ElementsAre(testing::Pair("CObservationOdd", 1),
                                                  testing::Pair("vendor::CObservationThermal", 2)));
  EXPECT_EQ(report.bytes_skipped,
            2 * foreign.size() + foreignObject("CObservationOdd", "abc").size());
  EXPECT_EQ(report.damaged_objects, 0u);
  EXPECT_FALSE(report.truncated);
}

TEST(RawlogReader, UnknownClassAtTheEndIsNoTruncation) {
  const std::string path = freshFolder() + "/foreign.rawlog";
  writeFile(path, bytesOf(*cloud(1, "lidar")) + foreignObject("vendor::CThing", "abc"));
  RawlogReader reader(path);
  EXPECT_THAT(stampsIn(reader), ElementsAre(1));
  EXPECT_FALSE(reader.report().truncated);
  EXPECT_EQ(reader.report().unknown_classes.at("vendor::CThing"), 1u);
}

TEST(RawlogReader, GoesOnAfterADamagedObject) {
  const std::string path = freshFolder() + "/damaged.rawlog";
  std::string bytes = bytesOf(threeObservations());
  const size_t third = bytes.size() / 3;
  bytes.replace(third + third / 2, 40, std::string(40, '\0'));
  bytes.erase(third + third / 3, 16);
  writeFile(path, bytes);
  RawlogReader reader(path);
  EXPECT_THAT(stampsIn(reader), ElementsAre(1, 3));
  EXPECT_EQ(reader.report().damaged_objects, 1u);
  EXPECT_EQ(reader.report().bytes_skipped, third - 16);
  EXPECT_FALSE(reader.report().truncated);
  EXPECT_THAT(reader.report().messages,
              ElementsAre(testing::AllOf(HasSubstr("byte " + std::to_string(third)),
                                         HasSubstr("CObservationPointCloud"))));
}

TEST(RawlogReader, GoesOnAfterRubbishBetweenObjectsAndAtTheBeginning) {
  const std::string path = freshFolder() + "/rubbish.rawlog";
  writeFile(path, "rubbish" + bytesOf(*cloud(1, "lidar")) + std::string(300000, '\x07') +
                      bytesOf(*cloud(2, "lidar")));
  RawlogReader reader(path);
  EXPECT_THAT(stampsIn(reader), ElementsAre(1, 2));
  EXPECT_EQ(reader.report().bytes_skipped, 300007u);
}

TEST(RawlogReader, SavesTheObservationsOfADamagedFrame) {
  const std::string path = freshFolder() + "/frame.rawlog";
  mrpt::obs::CSensoryFrame frame;
  for (const auto& o : {cloud(1, "a"), cloud(2, "b"), cloud(3, "c")}) frame.insert(o);
  std::string bytes = bytesOf(frame);
  // The middle one becomes an object of a class that nobody knows.
  const std::string name = "CObservationPointCloud";
  const size_t second = bytes.find(name, bytes.find(name) + name.size());
  bytes.replace(second, name.size(), "CObservationPointClown");
  writeFile(path, bytes + bytesOf(*cloud(4, "a")));
  RawlogReader reader(path);
  EXPECT_THAT(stampsIn(reader), ElementsAre(1, 3, 4));
  EXPECT_EQ(reader.report().unknown_classes.at("mrpt::obs::CObservationPointClown"), 1u);
}

TEST(RawlogReader, CorruptSizesDoNotFillTheMemory) {
  const std::string path = freshFolder() + "/huge.rawlog";
  const auto damaged = cloud(2, "lidar", 1000);
  std::string bytes = bytesOf(*damaged);
  const size_t count = bytes.find(std::string("\xe8\x03\0\0", 4));  // 1000 points
  ASSERT_NE(count, std::string::npos);
  bytes.replace(count, 4, std::string("\xff\xff\xff\x7f", 4));
  writeFile(path, bytesOf(*cloud(1, "lidar")) + bytes + bytesOf(*cloud(3, "lidar")));
  RawlogReader reader(path);
  EXPECT_THAT(stampsIn(reader), ElementsAre(1, 3));
  EXPECT_EQ(reader.report().damaged_objects, 1u);
  EXPECT_EQ(reader.report().bytes_skipped, bytes.size());
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 2 << 20) << "KiB";
}

TEST(RawlogReader, PassesOverComments) {
  const std::string path = freshFolder() + "/comment.rawlog";
  auto comment = mrpt::obs::CObservationComment::Create();
  comment->text = "made by a test";
  writeFile(path, bytesOf({comment, cloud(1, "lidar")}));
  RawlogReader reader(path);
  EXPECT_THAT(stampsIn(reader), ElementsAre(1));
  EXPECT_TRUE(reader.report().messages.empty());
}

}  // namespace
}  // namespace lamp
