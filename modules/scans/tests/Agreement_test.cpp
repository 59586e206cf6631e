#include "lamp/scans/Agreement.h"

#include <gtest/gtest.h>

#include "TestMotions.h"
#include "TestRooms.h"

namespace lamp {
namespace {

using namespace test;

TEST(Agreement, IsFullForTheSameRoomAndLowForAShiftedOne) {
  const auto a = prepareScan(roomPoints(6000, 0.01f, 1), 10, false);
  const auto b = prepareScan(roomPoints(3000, 0.01f, 2), 10, false);
  const Agreement same = agreement(*b, *a, Pose3::Identity(), 0.3);
  EXPECT_GT(same.overlap, 0.9);
  EXPECT_LT(same.residual_m, 0.05);
  const Agreement shifted = agreement(*b, *a, expSE3(tangent(3, 2, 1, 0, 0, 0.7)), 0.3);
  EXPECT_LT(shifted.overlap, 0.4);
  EXPECT_EQ(agreement(*prepareScan({}, 10, false), *a, Pose3::Identity(), 0.3).overlap, 0.0);
}

TEST(ShareInFreeSpace, IsSmallAtTheTruthAndLargeWhereRaysPassed) {
  const auto seen = [](const Pose3& room_T_eye, unsigned seed) {
    return prepareScan(moved(roomPoints(4000, 0.01f, seed), room_T_eye.inverse()), 10, false);
  };
  const Pose3 a(Eigen::Translation3d(-2, 0, 1)), b(Eigen::Translation3d(-1, 1, 1));
  const auto from_a = seen(a, 1), from_b = seen(b, 2);
  const Pose3 truth = a.inverse() * b;
  EXPECT_LT(shareInFreeSpace(*from_b, *from_a, truth, 0.3), 0.05);
  EXPECT_GT(shareInFreeSpace(*from_b, *from_a, planarPose(2, 0, 0) * truth, 0.3), 0.15);
  EXPECT_EQ(shareInFreeSpace(*prepareScan({}, 10, false), *from_a, truth, 0.3), 0.0);
}

}  // namespace
}  // namespace lamp
