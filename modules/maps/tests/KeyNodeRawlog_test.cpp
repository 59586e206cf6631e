#include "lamp/maps/KeyNodeRawlog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CRawlog.h>
#include <unistd.h>

#include "TestMaps.h"

namespace lamp {
namespace {

using mrpt::obs::CObservationPointCloud;
using mrpt::obs::CObservationRobotPose;
using testing::HasSubstr;

KeyNodePacket packet(uint32_t index, double stamp, const Pose3& odom_T_base, KeyedScanPtr scan) {
  KeyNodePacket p;
  p.id.index = index;
  p.stamp = stamp;
  p.odom_T_base = odom_T_base;
  p.scan = std::move(scan);
  return p;
}

std::shared_ptr<Scan> twoLidarScan() {
  const auto scan = makeScan({{5, 3, 0.1f}, {-4, 1, 2}, {5, -3, 0.1f}});
  scan->sensors = {{"front", {0.3, 0, 0.8}}, {"", {-0.3, 0.1, 0.9}}};
  scan->sensor = {0, 1, 0};
  scan->intensity = {10, 20.5f, 30};
  return scan;
}

mrpt::obs::CRawlog read(const std::string& path) {
  mrpt::obs::CRawlog rawlog;
  EXPECT_TRUE(rawlog.loadFromRawLogFile(path));
  return rawlog;
}

template <class Observation>
std::shared_ptr<Observation> at(const mrpt::obs::CRawlog& rawlog, size_t i) {
  return std::dynamic_pointer_cast<Observation>(rawlog.getAsObservation(i));
}

void expectPoint(const CObservationPointCloud& cloud, size_t i, const Eigen::Vector3f& base) {
  float x, y, z;
  cloud.pointcloud->getPoint(i, x, y, z);
  const auto p = cloud.sensorPose.composePoint(mrpt::math::TPoint3D(x, y, z));
  EXPECT_NEAR(p.x, base.x(), 1e-6);
  EXPECT_NEAR(p.y, base.y(), 1e-6);
  EXPECT_NEAR(p.z, base.z(), 1e-6);
}

TEST(KeyNodeRawlog, ReadsBackThroughMrpt) {
  const std::string path = freshFolder() + "/husky1.rawlog";
  Vector6d d;
  d << 1, -2, 0.5, 0.1, -0.2, 2.5;
  const Pose3 odom_T_base = expSE3(d);
  const double stamp = 1600000000.25;
  writeKeyNodeRawlog(path, "husky1", {packet(0, stamp, odom_T_base, twoLidarScan())});
  const auto rawlog = read(path);
  ASSERT_EQ(rawlog.size(), 3u);

  const auto odometry = at<CObservationRobotPose>(rawlog, 0);
  ASSERT_TRUE(odometry);
  EXPECT_EQ(odometry->sensorLabel, "husky1/odometry");
  EXPECT_NEAR(mrpt::Clock::toDouble(odometry->timestamp), stamp, 1e-6);
  const auto matrix = odometry->pose.mean.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>();
  EXPECT_LT((matrix.asEigen() - odom_T_base.matrix()).norm(), 1e-12);
  EXPECT_EQ(odometry->pose.cov.asEigen().norm(), 0);

  const auto front = at<CObservationPointCloud>(rawlog, 1);
  const auto rear = at<CObservationPointCloud>(rawlog, 2);
  ASSERT_TRUE(front && rear);
  EXPECT_EQ(front->sensorLabel, "husky1/front");
  EXPECT_EQ(rear->sensorLabel, "husky1/lidar");
  EXPECT_EQ(front->timestamp, odometry->timestamp);
  EXPECT_NEAR(rear->sensorPose.z(), 0.9, 1e-12);
  EXPECT_NEAR(rear->sensorPose.yaw(), 0, 1e-12);
  ASSERT_EQ(front->pointcloud->size(), 2u);
  ASSERT_EQ(rear->pointcloud->size(), 1u);
  expectPoint(*front, 0, {5, 3, 0.1f});
  expectPoint(*front, 1, {5, -3, 0.1f});
  expectPoint(*rear, 0, {-4, 1, 2});
  const auto bright = std::dynamic_pointer_cast<mrpt::maps::CPointsMapXYZI>(front->pointcloud);
  ASSERT_TRUE(bright);
  EXPECT_EQ(bright->getPointIntensity(0), 10);
  EXPECT_EQ(bright->getPointIntensity(1), 30);
}

TEST(KeyNodeRawlog, ScansWithoutIntensityAreSimpleMaps) {
  const std::string path = freshFolder() + "/a.rawlog";
  writeKeyNodeRawlog(path, "a", {packet(0, 1, Pose3::Identity(), makeScan({{1, 2, 3}}))});
  const auto rawlog = read(path);
  ASSERT_EQ(rawlog.size(), 2u);
  const auto cloud = at<CObservationPointCloud>(rawlog, 1);
  ASSERT_TRUE(cloud);
  EXPECT_TRUE(std::dynamic_pointer_cast<mrpt::maps::CSimplePointsMap>(cloud->pointcloud));
  expectPoint(*cloud, 0, {1, 2, 3});
}

TEST(KeyNodeRawlog, IsInStampOrder) {
  const std::string path = freshFolder() + "/a.rawlog";
  std::vector<KeyNodePacket> packets;
  for (const double stamp : {3.0, 1.0, 2.0})
    packets.push_back(packet(packets.size(), stamp, Pose3::Identity(), nullptr));
  writeKeyNodeRawlog(path, "a", packets);
  const auto rawlog = read(path);
  ASSERT_EQ(rawlog.size(), 3u);
  for (size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(mrpt::Clock::toDouble(rawlog.getAsObservation(i)->timestamp), 1.0 + i, 1e-6);
}

TEST(KeyNodeRawlog, WritesTheSameBytesTwiceWithoutTimeOrName) {
  const std::string folder = freshFolder();
  const std::vector<KeyNodePacket> packets{packet(0, 1, planarPose(1, 2, 3), twoLidarScan())};
  writeKeyNodeRawlog(folder + "/a.rawlog", "a", packets);
  writeKeyNodeRawlog(folder + "/b.rawlog", "a", packets);
  const std::string bytes = bytesOf(folder + "/a.rawlog");
  EXPECT_EQ(bytes, bytesOf(folder + "/b.rawlog"));
  ASSERT_GT(bytes.size(), 10u);
  // RFC 1952: magic, deflate, flags (8 would be a name), four bytes of time.
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x1f\x8b\x08\0\0\0\0\0", 8));
}

TEST(KeyNodeRawlog, NoPacketsAndEmptyScansGiveFilesThatOpen) {
  const std::string folder = freshFolder();
  writeKeyNodeRawlog(folder + "/none.rawlog", "a", {});
  EXPECT_EQ(read(folder + "/none.rawlog").size(), 0u);
  writeKeyNodeRawlog(folder + "/empty.rawlog", "a",
                     {packet(0, 1, Pose3::Identity(), makeScan({}))});
  const auto rawlog = read(folder + "/empty.rawlog");
  ASSERT_EQ(rawlog.size(), 2u);
  const auto cloud = at<CObservationPointCloud>(rawlog, 1);
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->pointcloud->size(), 0u);
}

TEST(KeyNodeRawlog, RefusesInvalidPacketsAndMissingFolders) {
  const std::string folder = freshFolder();
  const auto error = [&](const KeyNodePacket& p, const std::string& path) {
    return errorOf([&] { writeKeyNodeRawlog(path, "husky1", {p}); });
  };
  const KeyNodePacket good = packet(7, 1, Pose3::Identity(), makeScan({{1, 0, 0}}));
  EXPECT_THAT(error(good, folder + "/missing/a.rawlog"), HasSubstr(folder + "/missing/a.rawlog"));
  KeyNodePacket no_stamp = good, no_pose = good, no_sensor = good;
  no_stamp.stamp = std::nan("");
  no_pose.odom_T_base.translation().y() = std::nan("");
  const auto scan = makeScan({{1, 0, 0}});
  scan->sensor = {3};
  no_sensor.scan = scan;
  for (const KeyNodePacket& p : {no_stamp, no_pose, no_sensor})
    EXPECT_THAT(error(p, folder + "/a.rawlog"), HasSubstr("husky1:7"));
  EXPECT_EQ(fileCount(folder), 0u);
}

TEST(KeyNodeRawlog, TellsThatTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  const std::string folder = freshFolder();
  const std::string path = folder + "/a.rawlog";
  // The temporary file's name is known: path, ".tmp" and the process.
  std::filesystem::create_symlink("/dev/full", path + ".tmp" + std::to_string(::getpid()));
  EXPECT_THAT(errorOf([&] {
                writeKeyNodeRawlog(path, "a", {packet(0, 1, Pose3::Identity(), twoLidarScan())});
              }),
              HasSubstr(path));
  EXPECT_EQ(fileCount(folder), 0u);
}

}  // namespace
}  // namespace lamp
