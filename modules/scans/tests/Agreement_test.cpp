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
