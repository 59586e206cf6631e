#include "lamp/scans/LocalMap.h"

#include <gtest/gtest.h>

#include <limits>

#include "TestRooms.h"

namespace lamp {
namespace {

using Eigen::Vector3f;

const Vector3f kMiddle(0, 0, 1.5f);

LocalMap roomMap(float noise_m = 0) {
  LocalMap map(0.2, false);
  map.add(roomPoints(20000, noise_m, 1), Pose3::Identity(), kMiddle, 0);
  return map;
}

TEST(LocalMap, HoldsPointsAtLeastALeafApartWithinABlock) {
  LocalMap map(0.2, false);
  map.add({{0.1f, 0.1f, 0.1f}, {0.15f, 0.1f, 0.1f}, {0.4f, 0.1f, 0.1f}}, Pose3::Identity(), kMiddle,
          0);
  EXPECT_EQ(map.size(), 2u);
  EXPECT_EQ(map.points(), (std::vector<Vector3f>{{0.1f, 0.1f, 0.1f}, {0.4f, 0.1f, 0.1f}}))
      << "what was there first stays";
}

TEST(LocalMap, KnowsTheSurfaceAroundTheNearestPoint) {
  LocalMap map = roomMap(0.01f);
  const auto* wall = map.surfaceNear({4.8f, 0.3f, 1.6f}, 0.6f);
  ASSERT_NE(wall, nullptr);
  EXPECT_NEAR(wall->normal.x(), -1, 0.05) << "towards the lidar";
  EXPECT_NEAR(wall->center.x(), 5, 0.02);
  EXPECT_NEAR(wall->deviation_m, 0.01, 0.006);
  const auto* floor = map.surfaceNear({-2, -2, 0.1f}, 0.6f);
  ASSERT_NE(floor, nullptr);
  EXPECT_GT(floor->normal.z(), 0.99);
  EXPECT_EQ(map.surfaceNear(kMiddle, 0.6f), nullptr) << "nothing is near";
}

TEST(LocalMap, TakesTheLineOfOneRingForNoSurface) {
  LocalMap map(0.2, false);
  std::vector<Vector3f> ring;
  for (int i = 0; i < 200; ++i) ring.emplace_back(10.0f, -5 + 0.05f * static_cast<float>(i), 1.0f);
  map.add(ring, Pose3::Identity(), kMiddle, 0);
  EXPECT_EQ(map.surfaceNear({10, 0, 1}, 0.5f), nullptr);
}

TEST(LocalMap, FitsLinesToWhatANoisyLaserSees) {
  LocalMap map(0.05, true);
  map.add(planarRoomPoints(6000, 0.1f, 2), Pose3::Identity(), Vector3f::Zero(), 0);
  const auto* wall = map.surfaceNear({-4.0f, 0.0f, 0.0f}, 0.5f);
  ASSERT_NE(wall, nullptr);
  EXPECT_GT(wall->normal.x(), 0.95);
  EXPECT_EQ(wall->normal.z(), 0);
  EXPECT_NEAR(wall->deviation_m, 0.1, 0.04);
}

TEST(LocalMap, FitsAnewWhereItGrew) {
  LocalMap map(0.2, false);
  std::vector<Vector3f> lower, upper;
  for (const Vector3f& p : roomPoints(20000, 0, 3)) (p.z() < 1 ? lower : upper).push_back(p);
  map.add(lower, Pose3::Identity(), kMiddle, 0);
  EXPECT_EQ(map.surfaceNear({5, 0, 2}, 0.5f), nullptr);
  map.add(upper, Pose3::Identity(), kMiddle, 0);
  EXPECT_NE(map.surfaceNear({5, 0, 2}, 0.5f), nullptr);
}

TEST(LocalMap, MovesWhatItIsGiven) {
  LocalMap map(0.2, false);
  const Pose3 pose = planarPose(3, -2, 0.5);
  map.add({{1, 0, 0}}, pose, Vector3f::Zero(), 0);
  EXPECT_TRUE(map.points().front().isApprox((pose * Eigen::Vector3d(1, 0, 0)).cast<float>()));
}

TEST(LocalMap, ForgetsWhatIsFarOrWasSeenLongAgo) {
  LocalMap map(0.2, false);
  map.add({{0, 0, 0}, {50, 0, 0}}, Pose3::Identity(), Vector3f::Zero(), 0);
  map.add({{0, 0, 5}}, Pose3::Identity(), Vector3f::Zero(), 80);
  map.forget(0, Vector3f::Zero(), 20);
  EXPECT_EQ(map.size(), 2u) << "what is far is gone";
  map.forget(60, Vector3f::Zero(), 20);
  ASSERT_EQ(map.size(), 1u) << "what is old is gone";
  EXPECT_EQ(map.points().front().z(), 5);
}

TEST(LocalMap, LeavesOutPointsThatAreNone) {
  LocalMap map(0.2, false);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  map.add({{nan, 0, 0}, {0, std::numeric_limits<float>::infinity(), 0}, {1e8f, 0, 0}, {1, 1, 1}},
          Pose3::Identity(), kMiddle, 0);
  EXPECT_EQ(map.size(), 1u);
  EXPECT_EQ(LocalMap(0.2, false).surfaceNear({0, 0, 0}, 1), nullptr);
}

}  // namespace
}  // namespace lamp
