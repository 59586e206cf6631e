#include "lamp/scans/Agreement.h"

#include <gtest/gtest.h>

#include "TestRooms.h"

namespace lamp {
namespace {

TEST(Agreement, IsFullForTheSameRoomAndLowForAShiftedOne) {
  const auto a = prepareScan(roomPoints(6000, 0.01f, 1), 10, false);
  const auto b = prepareScan(roomPoints(3000, 0.01f, 2), 10, false);
  const Agreement same = agreement(*b, *a, Pose3::Identity(), 0.3);
  EXPECT_GT(same.overlap, 0.9);
  EXPECT_LT(same.residual_m, 0.05);
  Vector6d shift;
  shift << 3, 2, 1, 0, 0, 0.7;
  EXPECT_LT(agreement(*b, *a, expSE3(shift), 0.3).overlap, 0.4);
  EXPECT_EQ(agreement(*prepareScan({}, 10, false), *a, Pose3::Identity(), 0.3).overlap, 0.0);
  EXPECT_EQ(agreement(*a, *prepareScan({}, 10, false), Pose3::Identity(), 0.3).overlap, 0.0);
}

TEST(Agreement, OverlapIsWhatBothHaveSeenThemselves) {
  // The neighbour adds what lies behind the target's own lidar.
  Cloud cloud = cloudSeenFromOrigin(roomPoints(6000, 0.01f, 1));
  cloud.viewpoints.push_back(cloud.viewpoints.front());
  for (size_t i = 0; i < cloud.size(); ++i) cloud.viewpoint[i] = cloud.points[i].x() < 0 ? 1 : 0;
  const PreparedScan target(cloud, {}, false);
  const auto source = prepareScan(roomPoints(3000, 0.01f, 2), 10, false);
  const Agreement found = agreement(*source, target, Pose3::Identity(), 0.3);
  EXPECT_NEAR(found.overlap, static_cast<double>(target.own().size()) / 6000, 0.1);
  EXPECT_LT(found.overlap, 0.7);
  EXPECT_GT(static_cast<double>(found.matches) / 2000, 0.9) << "the residual counts all";
}

TEST(Agreement, LengthsGrowWithTheSpacingOfThePoints) {
  const auto scaledRoom = [](float scale, unsigned seed) {
    auto points = roomPoints(800, 0.01f, seed);
    for (auto& p : points) p *= scale;
    return prepareScan(points, 10, false);
  };
  const auto at = [](double scale) { return Pose3(Eigen::Translation3d(0.1 * scale, 0, 0)); };
  const Agreement small = agreement(*scaledRoom(4, 1), *scaledRoom(4, 2), at(4), 0.3);
  const Agreement large = agreement(*scaledRoom(8, 1), *scaledRoom(8, 2), at(8), 0.3);
  EXPECT_GT(small.overlap, 0.2);
  EXPECT_NEAR(small.overlap, large.overlap, 0.01);
  EXPECT_NEAR(2 * small.residual_m, large.residual_m, 0.01);
}

TEST(ShareInFreeSpace, IsSmallAtTheRightPoseAndLargeWhereRaysPassed) {
  // The lidar at eye level, so that no surface is seen edge on.
  auto points = roomPoints(6000, 0.0f, 1);
  for (auto& p : points) p.z() -= 1.2f;
  const auto room = prepareScan(points, 10, false);
  EXPECT_LT(shareInFreeSpace(*room, *room, Pose3::Identity(), 0.3), 0.02);
  const auto inside = prepareScan({{1, 0, 0}, {-1, 1, 0}, {0, -2, 0}}, 10, false);
  EXPECT_EQ(shareInFreeSpace(*inside, *room, Pose3::Identity(), 0.3), 1.0);
  EXPECT_EQ(shareInFreeSpace(*prepareScan({}, 10, false), *room, Pose3::Identity(), 0.3), 0.0);
}

}  // namespace
}  // namespace lamp
