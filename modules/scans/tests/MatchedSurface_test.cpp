#include "lamp/scans/MatchedSurface.h"

#include <gtest/gtest.h>

#include "TestCorridors.h"
#include "TestRooms.h"

namespace lamp {
namespace {

using Eigen::Vector3f;
constexpr double kDistance_m = 0.5, kKernel_m = 0.2;

std::vector<Vector3f> moved(std::vector<Vector3f> points, const Pose3& T) {
  const Eigen::Isometry3f Tf = T.cast<float>();
  for (auto& p : points) p = Tf * p;
  return points;
}

/** A floor of 4 x 4 m, a metre below the lidar. */
std::vector<Vector3f> floorPoints() {
  std::vector<Vector3f> points;
  for (int i = -10; i <= 10; ++i)
    for (int j = -10; j <= 10; ++j) points.emplace_back(0.2f * i, 0.2f * j, -1.0f);
  return points;
}

TEST(MatchedSurface, InformationIsTheSumOfPointToPlaneJacobians) {
  // About the centroid, h = [n, lever x n] with n = z.
  const auto scan = prepareScan(floorPoints(), 8, false);
  const MatchedSurface surface =
      matchedSurface(*scan, *scan, Pose3::Identity(), kDistance_m, kKernel_m);
  Matrix6d expected = Matrix6d::Zero();
  double count = 0;
  for (size_t i = 0; i < scan->size(); ++i) {
    Vector6d h = Vector6d::Zero();
    h[2] = 1;
    h[3] = scan->points()[i].y();
    h[4] = -scan->points()[i].x();
    expected += h * h.transpose();
    ++count;
  }
  EXPECT_EQ(count, 441);
  EXPECT_LT((surface.information - expected).norm(), 1e-3 * expected.norm());
  EXPECT_NEAR(surface.weights, count, 1e-6 * count);
  EXPECT_NEAR(surface.residual_m, 0, 1e-6);
  EXPECT_EQ(surface.patches, 25);
}

TEST(MatchedSurface, WhatTheRingsDrawHoldsNothing) {
  const TestLidar lidar{128, 1024, 100, 0.01};
  const auto target = prepareScan(scanOf({}, lidar, 0, 1), 10, false);
  const auto source = prepareScan(scanOf({}, lidar, 7, 2), 10, false);
  const MatchedSurface surface =
      matchedSurface(*source, *target, Pose3::Identity(), kDistance_m, kKernel_m);
  double normals = 0;
  for (const Vector3f& normal : target->normals()) normals += normal.x() * normal.x();
  EXPECT_GT(normals, 0.05 * static_cast<double>(target->size())) << "by the normals alone";
  EXPECT_LT(surface.information(0, 0), 0.01 * surface.weights);
  EXPECT_GT(surface.information(1, 1), 0.2 * surface.weights);
}

TEST(MatchedSurface, ResidualIsTheDistanceAcross) {
  const auto target = prepareScan(floorPoints(), 8, false);
  const auto source =
      prepareScan(moved(floorPoints(), Pose3(Eigen::Translation3d(0, 0, 0.03))), 8, false);
  const MatchedSurface surface =
      matchedSurface(*source, *target, Pose3::Identity(), kDistance_m, kKernel_m);
  EXPECT_NEAR(surface.residual_m, 0.03, 1e-4);
}

TEST(MatchedSurface, IsAboutThePivotInTheTargetsAxes) {
  // The same room, seen from a frame that is turned and 50 m away: the pivot goes with it.
  Vector6d motion;
  motion << 50, -20, 5, 0.1, 0.2, 1.0;
  const Pose3 target_T_source = expSE3(motion);
  const auto seenFrom = [](const Eigen::Vector3d& eye, std::vector<Vector3f> points) {
    Cloud cloud = cloudSeenFromOrigin(std::move(points));
    cloud.viewpoints = {eye.cast<float>()};
    return std::make_shared<PreparedScan>(cloud, ScanPreparationOptions{}, false);
  };
  const auto room = roomPoints(1400, 0.0f, 1);
  const Eigen::Vector3d eye(0, 0, 1);
  const auto target = seenFrom(eye, room);
  const auto source =
      seenFrom(target_T_source.inverse() * eye, moved(room, target_T_source.inverse()));
  const MatchedSurface same =
      matchedSurface(*target, *target, Pose3::Identity(), kDistance_m, kKernel_m);
  const MatchedSurface far =
      matchedSurface(*source, *target, target_T_source, kDistance_m, kKernel_m);
  EXPECT_LT((far.pivot - same.pivot).norm(), 1e-3);
  EXPECT_LT((far.information - same.information).norm(), 0.01 * same.information.norm());
  EXPECT_NEAR(far.radius_m, same.radius_m, 1e-3);
  EXPECT_GT(far.patches, 20);
}

TEST(MatchedSurface, IsNoneOfNothing) {
  const auto room = prepareScan(roomPoints(500, 0.01f, 1), 10, false);
  for (const auto& other :
       {prepareScan({}, 10, false), prepareScan({{500, 0, 0}, {501, 0, 0}}, 10, false)}) {
    EXPECT_EQ(matchedSurface(*other, *room, Pose3::Identity(), 0.5, 0.2).weights, 0);
    EXPECT_TRUE(matchedSurface(*room, *other, Pose3::Identity(), 0.5, 0.2).information.isZero());
  }
}

}  // namespace
}  // namespace lamp
