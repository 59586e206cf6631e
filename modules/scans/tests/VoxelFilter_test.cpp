#include "lamp/scans/VoxelFilter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "TestRooms.h"

namespace lamp {
namespace {

Scan scanOf(std::vector<Eigen::Vector3f> points) {
  Scan scan;
  scan.sensor.assign(points.size(), 0);
  scan.points = std::move(points);
  scan.sensors.push_back({"lidar", Eigen::Vector3d::Zero()});
  return scan;
}

TEST(VoxelFilter, OneMeanPointForEachCell) {
  Scan scan = scanOf({{0.1f, 0.1f, 0.1f}, {0.3f, 0.3f, 0.3f}, {1.5f, 0.1f, 0.1f}, {-0.1f, 0, 0}});
  scan.intensity = {1, 3, 5, 7};
  const Scan filtered = voxelFilter(scan, 1.0);
  ASSERT_EQ(filtered.size(), 3u);
  EXPECT_TRUE(filtered.points[0].isApprox(Eigen::Vector3f(0.2f, 0.2f, 0.2f)));
  EXPECT_EQ(filtered.intensity, (std::vector<float>{2, 5, 7}));
  EXPECT_TRUE(filtered.points[2].isApprox(Eigen::Vector3f(-0.1f, 0, 0)));
}

TEST(VoxelFilter, DoesNotMixSensors) {
  Scan scan = scanOf({{0.1f, 0.1f, 0.1f}, {0.3f, 0.3f, 0.3f}});
  scan.sensor = {0, 1};
  scan.sensors.push_back({"second", Eigen::Vector3d(1, 0, 0)});
  const Scan filtered = voxelFilter(scan, 1.0);
  EXPECT_EQ(filtered.sensor, (std::vector<uint8_t>{0, 1}));
  EXPECT_EQ(filtered.sensors.size(), 2u);
}

TEST(VoxelFilter, LeavesOutWhatIsNoPlace) {
  const Scan filtered = voxelFilter(
      scanOf({{NAN, 0, 0}, {1, 2, 3}, {0, INFINITY, 0}, {0, 0, -3e38f}, {2e6f, 0, 0}}), 0.1);
  ASSERT_EQ(filtered.size(), 1u);
  EXPECT_TRUE(filtered.points[0].isApprox(Eigen::Vector3f(1, 2, 3)));
}

TEST(VoxelFilter, NoPointsGiveNoPoints) {
  EXPECT_EQ(voxelFilter(scanOf({}), 0.5).size(), 0u);
}

TEST(AdaptiveVoxelFilter, ComesNearTheTargetForDifferentLidars) {
  for (const size_t raw : {20000u, 120000u}) {
    AdaptiveVoxelFilter filter(AdaptiveVoxelOptions{});
    const Scan scan = scanOf(roomPoints(raw, 0.01f, 1));
    size_t points = 0;
    for (int i = 0; i < 3; ++i) points = filter.filter(scan).size();
    EXPECT_NEAR(static_cast<double>(points), 3000, 450) << raw;
  }
}

TEST(AdaptiveVoxelFilter, RobotsWithOneAndThreeLidarsGetAlikeScans) {
  AdaptiveVoxelFilter spot(AdaptiveVoxelOptions{}), husky(AdaptiveVoxelOptions{});
  for (unsigned seed = 0; seed < 12; ++seed) {
    Scan three = scanOf(roomPoints(45000, 0.02f, seed));
    for (size_t i = 0; i < three.size(); ++i) three.sensor[i] = static_cast<uint8_t>(i / 15000);
    three.sensors.assign(3, three.sensors.front());
    const double few =
        static_cast<double>(spot.filter(scanOf(roomPoints(15000, 0.02f, seed))).size());
    const double many = static_cast<double>(husky.filter(three).size());
    if (seed < 10) continue;  // scans until it has settled
    EXPECT_LT(std::abs(std::log(many / few)), std::log(1.15)) << many << " " << few;
  }
}

TEST(AdaptiveVoxelFilter, LeavesOutLonePoints) {
  std::vector<Eigen::Vector3f> points = roomPoints(20000, 0.01f, 1);
  const size_t room = points.size();
  for (int i = 0; i < 200; ++i)  // dust, high above the room
    points.emplace_back(static_cast<float>(5 * (i % 10)), static_cast<float>(5 * (i / 10)), 50.0f);
  ASSERT_EQ(points.size(), room + 200);
  AdaptiveVoxelFilter filter(AdaptiveVoxelOptions{});
  const Scan filtered = filter.filter(scanOf(points));
  EXPECT_NEAR(static_cast<double>(filtered.size()), 3000, 450);
  for (const Eigen::Vector3f& point : filtered.points) EXPECT_LT(point.z(), 40);
}

TEST(AdaptiveVoxelFilter, KeepsAThinScan) {
  AdaptiveVoxelFilter filter(AdaptiveVoxelOptions{});
  EXPECT_EQ(filter.filter(scanOf({{5, 0, 0}, {0, 5, 0}, {-5, 0, 2}, {0, -5, 2}})).size(), 4u);
}

TEST(AdaptiveVoxelFilter, StaysWithinItsLeafLimits) {
  AdaptiveVoxelOptions options;
  options.target_points = 1000000;
  AdaptiveVoxelFilter fine(options);
  for (int i = 0; i < 5; ++i) fine.filter(scanOf(roomPoints(5000, 0.01f, 1)));
  EXPECT_DOUBLE_EQ(fine.leaf(), options.min_leaf_m);
  options.target_points = 1;
  AdaptiveVoxelFilter coarse(options);
  for (int i = 0; i < 5; ++i) coarse.filter(scanOf(roomPoints(5000, 0.01f, 1)));
  EXPECT_DOUBLE_EQ(coarse.leaf(), options.max_leaf_m);
}

TEST(AdaptiveVoxelFilter, AnEmptyScanDoesNotUpsetTheLeaf) {
  AdaptiveVoxelFilter filter(AdaptiveVoxelOptions{});
  const double before = filter.leaf();
  EXPECT_EQ(filter.filter(scanOf({})).size(), 0u);
  EXPECT_DOUBLE_EQ(filter.leaf(), before);
}

}  // namespace
}  // namespace lamp
