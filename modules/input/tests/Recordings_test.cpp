/** Recordings made by others. */
#include <gmock/gmock.h>
#include <mrpt/obs/CRawlog.h>

#include "RecordingTools.h"
#include "lamp/core/Geometry.h"
#include "lamp/input/OdometryFromObservation.h"
#include "lamp/input/RawlogSource.h"
#include "lamp/input/ScanFromObservation.h"

namespace lamp {
namespace {

using namespace test;

constexpr char kSena[] = "2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog";

struct Contents {
  size_t scans = 0, points = 0, odometry = 0, out_of_order = 0;
  Pose3 last_odometry = Pose3::Identity();
  double last_odometry_stamp = 0;
};

Contents readAll(RawlogSource& source) {
  Contents contents;
  double last_stamp = 0;
  while (const auto o = source.next()) {
    if (o->stamp < last_stamp) ++contents.out_of_order;
    last_stamp = o->stamp;
    if (const auto scan = scanFromObservation(*o->observation, o->label, {})) {
      ++contents.scans;
      contents.points += scan->size();
    }
    if (const auto reading = odometryFromObservation(*o->observation)) {
      ++contents.odometry;
      contents.last_odometry = reading->odom_T_base;
      contents.last_odometry_stamp = reading->stamp;
    }
  }
  return contents;
}

Contents readAll(const std::string& path) {
  RobotTable table;
  RawlogSource source({path}, {}, table);
  return readAll(source);
}

Scan firstScan(const std::string& path) {
  RobotTable table;
  RawlogSource source({path}, {}, table);
  return *scanFromObservation(*source.next()->observation, "lidar", {});
}

TEST(Recordings, SenaActionPairs) {
  const std::string path = mrptRecording(kSena);
  if (path.empty()) GTEST_SKIP() << "mrpt-common's recordings are not installed";
  const Contents contents = readAll(path);
  EXPECT_EQ(contents.scans, 225u);
  EXPECT_EQ(contents.odometry, 225u) << "224 actions and the start";
  EXPECT_EQ(contents.out_of_order, 0u);

  // MRPT's own reader as the truth.
  mrpt::obs::CRawlog rawlog;
  rawlog.loadFromRawLogFile(path);
  mrpt::poses::CPose2D sum;
  size_t actions = 0;
  for (size_t i = 0; i < rawlog.size(); ++i) {
    if (rawlog.getType(i) != mrpt::obs::CRawlog::etActionCollection) continue;
    sum = sum + rawlog.getAsAction(i)->getBestMovementEstimation()->poseChange->getMeanVal();
    ++actions;
  }
  EXPECT_EQ(actions, 224u);
  EXPECT_NEAR(contents.last_odometry.translation().x(), sum.x(), 1e-6);
  EXPECT_NEAR(contents.last_odometry.translation().y(), sum.y(), 1e-6);
  EXPECT_NEAR(yawOf(contents.last_odometry), sum.phi(), 1e-6);
  EXPECT_NEAR(contents.last_odometry_stamp, 1137834284.788331, 1e-5);
}

TEST(Recordings, DepthCamera) {
  const std::string path = mrptRecording("tests_rgbd.rawlog");
  if (path.empty()) GTEST_SKIP() << "MRPT's recordings are not installed";
  const Scan scan = firstScan(path);
  EXPECT_GT(scan.size(), 200000u);
  for (const Eigen::Vector3f& p : scan.points) ASSERT_GT(p.x(), 0);
}

TEST(Recordings, AllOfMrptsAreReadWhole) {
  const std::string folder = mrptRecording("");
  if (folder.empty()) GTEST_SKIP() << "MRPT's recordings are not installed";
  size_t recordings = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".rawlog") continue;
    ++recordings;
    RobotTable table;
    RawlogSource source({entry.path().string()}, {}, table);
    readAll(source);
    const RawlogReport report = source.recordings().at(0).file;
    EXPECT_GT(report.objects, 0u) << entry;
    EXPECT_EQ(report.bytes_skipped, 0u) << entry;
    EXPECT_FALSE(report.truncated) << entry;
  }
  EXPECT_GT(recordings, 0u);
}

TEST(Recordings, BalmTeamMerges) {
  const std::string folder = dataFolder();
  if (folder.empty()) GTEST_SKIP() << "no data folder; set LAMP_DATA";
  RobotTable table;
  RawlogSource source(
      {folder + "/balm_indoor/robotA.rawlog", folder + "/balm_indoor/robotB.rawlog"}, {}, table);
  const Contents contents = readAll(source);
  EXPECT_EQ(contents.scans, 49u + 40u);
  EXPECT_EQ(contents.odometry, 49u + 40u);
  EXPECT_EQ(contents.out_of_order, 0u);
  EXPECT_GT(contents.points, 2000000u);
  EXPECT_EQ(table.size(), 2u);
  EXPECT_TRUE(source.warnings().empty());
}

TEST(Recordings, CutCopyOfBalm) {
  const std::string folder = dataFolder();
  if (folder.empty()) GTEST_SKIP() << "no data folder; set LAMP_DATA";
  const std::string whole = readFile(folder + "/balm_indoor/robotA.rawlog");
  const std::string path = freshFolder() + "/robotA.rawlog";
  writeFile(path, whole.substr(0, whole.size() / 2));
  RobotTable table;
  RawlogSource source({path}, {}, table);
  const Contents contents = readAll(source);
  EXPECT_GE(contents.scans, 20u);
  EXPECT_LE(contents.scans, 29u);
  EXPECT_TRUE(source.recordings().at(0).file.truncated);
  EXPECT_THAT(source.warnings(), testing::Contains(testing::HasSubstr("cut off")));
}

TEST(Recordings, RadishAces) {
  const std::string folder = dataFolder();
  if (folder.empty()) GTEST_SKIP() << "no data folder; set LAMP_DATA";
  const Contents contents = readAll(folder + "/radish2d/aces.rawlog");
  EXPECT_EQ(contents.scans, 7374u);
  EXPECT_EQ(contents.odometry, 7374u);
  EXPECT_EQ(contents.out_of_order, 0u);
}

}  // namespace
}  // namespace lamp
