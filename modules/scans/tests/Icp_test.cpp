#include "lamp/scans/Icp.h"

#include <gtest/gtest.h>

#include <cmath>

#include "TestRooms.h"

namespace lamp {
namespace {

constexpr double kDegree = M_PI / 180.0;

std::vector<Eigen::Vector3f> moved(std::vector<Eigen::Vector3f> points, const Pose3& T) {
  const Eigen::Isometry3f Tf = T.cast<float>();
  for (auto& p : points) p = Tf * p;
  return points;
}

Vector6d errorOf(const Pose3& truth, const Pose3& estimate) {
  return logSE3(truth.inverse() * estimate);
}

Vector6d tangent(double x, double y, double z, double rx, double ry, double rz) {
  Vector6d v;
  v << x, y, z, rx, ry, rz;
  return v;
}

class IcpMetrics : public testing::TestWithParam<IcpMetric> {};
INSTANTIATE_TEST_SUITE_P(All, IcpMetrics,
                         testing::Values(IcpMetric::kPlaneToPlane, IcpMetric::kPointToPlane));

TEST_P(IcpMetrics, FindsAKnownMotionBetweenIndependentSamples) {
  const Pose3 target_T_source = expSE3(tangent(0.4, -0.3, 0.2, 0.05, -0.04, 0.15));
  const auto target = prepareScan(roomPoints(4000, 0.01f, 1), 10, false);
  const auto source =
      prepareScan(moved(roomPoints(3000, 0.01f, 2), target_T_source.inverse()), 10, false);
  const IcpResult result = icp(*source, *target, Pose3::Identity(), GetParam(), IcpOptions{});
  ASSERT_TRUE(result.converged);
  const Vector6d error = errorOf(target_T_source, result.target_T_source);
  EXPECT_LT(error.head<3>().norm(), 0.02);
  EXPECT_LT(error.tail<3>().norm(), 0.3 * kDegree);
}

TEST_P(IcpMetrics, ScansOfALidarMountedUpsideDownOrTiltedRegisterAsWell) {
  const Pose3 target_T_source = expSE3(tangent(0.4, -0.3, 0.2, 0.05, -0.04, 0.15));
  const auto target_points = roomPoints(4000, 0.01f, 1);
  const auto source_points = moved(roomPoints(3000, 0.01f, 2), target_T_source.inverse());
  for (const Vector6d& mounting :
       {tangent(0, 0, 0.5, M_PI, 0, 0), tangent(0, 0, 0.5, 0, 45 * kDegree, 0),
        tangent(0, 0, 0.5, 0, 90 * kDegree, 0)}) {
    const Pose3 base_T_lidar = expSE3(mounting), lidar_T_base = base_T_lidar.inverse();
    const auto target = prepareScan(moved(target_points, lidar_T_base), 10, false);
    const auto source = prepareScan(moved(source_points, lidar_T_base), 10, false);
    const IcpResult result = icp(*source, *target, Pose3::Identity(), GetParam(), IcpOptions{});
    ASSERT_TRUE(result.converged);
    const Vector6d error =
        errorOf(target_T_source, base_T_lidar * result.target_T_source * lidar_T_base);
    EXPECT_LT(error.head<3>().norm(), 0.02) << mounting.transpose();
    EXPECT_LT(error.tail<3>().norm(), 0.3 * kDegree) << mounting.transpose();
  }
}

TEST_P(IcpMetrics, BothDirectionsAgree) {
  const Pose3 target_T_source = expSE3(tangent(0.3, 0.2, 0.1, 0.02, 0.03, -0.1));
  const auto a = prepareScan(roomPoints(4000, 0.01f, 1), 10, false);
  const auto b =
      prepareScan(moved(roomPoints(4000, 0.01f, 2), target_T_source.inverse()), 10, false);
  const Pose3 forth = icp(*b, *a, Pose3::Identity(), GetParam(), {}).target_T_source;
  const Pose3 back = icp(*a, *b, Pose3::Identity(), GetParam(), {}).target_T_source;
  EXPECT_LT(logSE3(forth * back).norm(), 0.02);
}

TEST_P(IcpMetrics, PlanarScansStayInThePlane) {
  const Pose3 target_T_source = planarPose(0.4, -0.2, 10 * kDegree);
  const auto target = prepareScan(planarRoomPoints(720, 0.01f, 1), 6, true);
  const auto source =
      prepareScan(moved(planarRoomPoints(360, 0.01f, 2), target_T_source.inverse()), 6, true);
  const IcpResult result = icp(*source, *target, Pose3::Identity(), GetParam(), IcpOptions{});
  ASSERT_TRUE(result.converged);
  const Vector6d error = errorOf(target_T_source, result.target_T_source);
  EXPECT_LT(error.head<3>().norm(), 0.02);
  EXPECT_LT(error.tail<3>().norm(), 0.5 * kDegree);
  EXPECT_EQ(result.target_T_source.translation().z(), 0.0);
  EXPECT_EQ(result.target_T_source.linear()(2, 2), 1.0);
}

TEST_P(IcpMetrics, RefusesWhatCannotBeAligned) {
  const auto room = prepareScan(roomPoints(1000, 0.01f, 1), 10, false);
  const std::vector<std::vector<Eigen::Vector3f>> hopeless = {
      {},
      {{0, 0, 0}},
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
      std::vector<Eigen::Vector3f>(50, Eigen::Vector3f(100, 100, 100))};
  for (const auto& points : hopeless) {
    const auto scan = prepareScan(points, 10, false);
    EXPECT_FALSE(icp(*scan, *room, Pose3::Identity(), GetParam(), {}).converged) << points.size();
    EXPECT_FALSE(icp(*room, *scan, Pose3::Identity(), GetParam(), {}).converged) << points.size();
  }
}

TEST_P(IcpMetrics, ASinglePlaneLeavesUnobservedDirectionsAlone) {
  std::vector<Eigen::Vector3f> plane;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j) plane.emplace_back(0.1f * i, 0.1f * j, 0.0f);
  const auto target = prepareScan(plane, 10, false);
  const auto source = prepareScan(moved(plane, expSE3(tangent(0, 0, 0.1, 0, 0, 0))), 10, false);
  const IcpResult result = icp(*source, *target, Pose3::Identity(), GetParam(), IcpOptions{});
  EXPECT_TRUE(result.target_T_source.matrix().allFinite());
  EXPECT_NEAR(result.target_T_source.translation().z(), -0.1, 0.01);
}

TEST_P(IcpMetrics, WorksTenKilometresFromTheOrigin) {
  const Pose3 offset(Eigen::Translation3d(10000, -10000, 100));
  const Pose3 motion = expSE3(tangent(0.2, -0.3, 0.1, 0.02, -0.01, 0.05));
  const auto target = prepareScan(moved(roomPoints(4000, 0.01f, 1), offset), 10, false);
  const auto source =
      prepareScan(moved(moved(roomPoints(3000, 0.01f, 2), motion.inverse()), offset), 10, false);
  const IcpResult result = icp(*source, *target, Pose3::Identity(), GetParam(), IcpOptions{});
  ASSERT_TRUE(result.converged);
  const Vector6d error = errorOf(motion, Pose3(offset.inverse() * result.target_T_source * offset));
  EXPECT_LT(error.head<3>().norm(), 0.03);
  EXPECT_LT(error.tail<3>().norm(), 0.3 * kDegree);
}

TEST_P(IcpMetrics, IgnoresPointsThatAreNotFinite) {
  auto points = roomPoints(2000, 0.01f, 2);
  const auto clean = prepareScan(points, 10, false);
  points.emplace_back(NAN, 0.0f, 0.0f);
  points.emplace_back(0.0f, INFINITY, 0.0f);
  const auto dirty = prepareScan(points, 10, false);
  const auto target = prepareScan(roomPoints(3000, 0.01f, 1), 10, false);
  EXPECT_EQ(icp(*dirty, *target, Pose3::Identity(), GetParam(), {}).target_T_source.matrix(),
            icp(*clean, *target, Pose3::Identity(), GetParam(), {}).target_T_source.matrix());
}

TEST_P(IcpMetrics, AFloorIsNotMatchedWithACeiling) {
  std::vector<Eigen::Vector3f> floor, ceiling;
  for (int i = -20; i < 20; ++i)
    for (int j = -20; j < 20; ++j) {
      floor.emplace_back(0.1f * i, 0.1f * j, -1.0f);
      ceiling.emplace_back(0.1f * i, 0.1f * j, 1.0f);
    }
  const Pose3 onto_each_other = Pose3(Eigen::Translation3d(0, 0, 2));
  const IcpResult result = icp(*prepareScan(floor, 10, false), *prepareScan(ceiling, 10, false),
                               onto_each_other, GetParam(), {});
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.matches, 0u);
}

}  // namespace
}  // namespace lamp
