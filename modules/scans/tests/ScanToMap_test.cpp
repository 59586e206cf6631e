#include "lamp/scans/ScanToMap.h"

#include <gtest/gtest.h>

#include "TestRooms.h"
#include "lamp/scans/RegistrationInformation.h"

namespace lamp {
namespace {

using Eigen::Vector3f;

std::vector<Vector3f> seenFrom(const Pose3& map_T_scan, const std::vector<Vector3f>& points) {
  const Eigen::Isometry3f T = map_T_scan.inverse().cast<float>();
  std::vector<Vector3f> result;
  for (const Vector3f& point : points) result.push_back(T * point);
  return result;
}

Pose3 somePose() {
  Vector6d pose;
  pose << 0.8, -0.5, 1.2, 0.4, 0.03, -0.02;
  return poseFromYawPitchRoll(pose);
}

Pose3 slightlyOff(const Pose3& pose) {
  Vector6d d;
  d << 0.2, -0.15, 0.1, 0.02, -0.03, 0.05;
  return pose * expSE3(d);
}

void expectNear(const Pose3& found, const Pose3& truth, double metres, double radians) {
  EXPECT_LT((found.translation() - truth.translation()).norm(), metres);
  EXPECT_LT(rotationAngle(found.inverse() * truth), radians);
}

TEST(ScanToMap, FindsThePoseOfAScan) {
  LocalMap map(0.2, false);
  map.add(roomPoints(20000, 0.01f, 1), Pose3::Identity(), {0, 0, 1.5f}, 0);
  const Pose3 truth = somePose();
  const auto result =
      registerToMap(seenFrom(truth, roomPoints(3000, 0.01f, 2)), map, slightlyOff(truth), 0.6);
  EXPECT_TRUE(result.converged);
  EXPECT_GT(result.matched_share, 0.8);
  EXPECT_NEAR(result.deviation_m, 0.01, 0.005);
  expectNear(result.map_T_scan, truth, 0.005, 0.001);
}

TEST(ScanToMap, InThePlaneMovesInThePlane) {
  LocalMap map(0.05, true);
  map.add(planarRoomPoints(6000, 0.01f, 1), Pose3::Identity(), Vector3f::Zero(), 0);
  const Pose3 truth = planarPose(0.5, -0.4, 0.3);
  const auto result = registerToMap(seenFrom(truth, planarRoomPoints(700, 0.01f, 2)), map,
                                    planarPose(0.6, -0.3, 0.25), 0.5);
  EXPECT_TRUE(result.converged);
  expectNear(result.map_T_scan, truth, 0.005, 0.001);
  EXPECT_EQ(result.map_T_scan.translation().z(), 0);
  EXPECT_EQ(result.map_T_scan.linear()(2, 2), 1);
}

TEST(ScanToMap, ToleratesWhatTheMapDoesNotHold) {
  LocalMap map(0.2, false);
  map.add(roomPoints(20000, 0.01f, 1), Pose3::Identity(), {0, 0, 1.5f}, 0);
  const Pose3 truth = somePose();
  auto points = roomPoints(3000, 0.01f, 2);
  for (int i = 0; i < 1000; ++i)  // somebody walks through
    points.emplace_back(-2 + 0.0005f * static_cast<float>(i), 0.5f,
                        0.0018f * static_cast<float>(i));
  const auto result = registerToMap(seenFrom(truth, points), map, slightlyOff(truth), 0.6);
  EXPECT_TRUE(result.converged);
  expectNear(result.map_T_scan, truth, 0.01, 0.002);
}

/** Floor, ceiling and side walls of a straight tunnel along x. */
std::vector<Vector3f> tunnel(size_t count, unsigned seed) {
  std::vector<Vector3f> result;
  for (const Vector3f& p : roomPoints(3 * count, 0.01f, seed)) {
    const bool across = std::abs(p.x()) > 4.9f || (p.x() > 1.9f && p.y() > 0.9f && p.y() < 1.1f);
    if (!across) result.emplace_back(2 * p.x(), p.y(), p.z());
  }
  return result;
}

TEST(ScanToMap, SaysThatATunnelLeavesItsAxisFree) {
  LocalMap map(0.2, false);
  map.add(tunnel(20000, 1), Pose3::Identity(), {0, 0, 1.5f}, 0);
  const auto result =
      registerToMap(seenFrom(Pose3::Identity(), tunnel(2000, 2)), map, Pose3::Identity(), 0.3);
  ASSERT_TRUE(result.converged);
  const auto information = registrationInformation(result.surface, result.map_T_scan,
                                                   RegistrationInformationOptions(), false);
  ASSERT_EQ(information.unobserved.size(), 1u);
  EXPECT_LT(information.information(0, 0), 1e-4 * information.information(1, 1));
}

TEST(ScanToMap, RefusesWhatMatchesNothing) {
  LocalMap map(0.2, false);
  EXPECT_FALSE(registerToMap(roomPoints(3000, 0, 1), map, Pose3::Identity(), 1).converged);
  map.add(roomPoints(20000, 0, 1), Pose3::Identity(), {0, 0, 1.5f}, 0);
  EXPECT_FALSE(registerToMap({}, map, Pose3::Identity(), 1).converged);
  EXPECT_FALSE(registerToMap(roomPoints(3000, 0, 1), map, planarPose(100, 0, 0), 1).converged);
}

}  // namespace
}  // namespace lamp
