#include "lamp/scans/Icp.h"

#include <gtest/gtest.h>

#include <cmath>

#include "TestMotions.h"
#include "TestRooms.h"

namespace lamp {
namespace {

using namespace test;

Vector6d errorOf(const Pose3& truth, const Pose3& estimate) {
  return logSE3(truth.inverse() * estimate);
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
    for (int j = 0; j < 40; ++j) plane.emplace_back(0.1f * i, 0.1f * j, -1.0f);
  const auto target = prepareScan(plane, 10, false);
  const auto source = prepareScan(moved(plane, expSE3(tangent(0, 0, 0.1, 0, 0, 0))), 10, false);
  const IcpResult result = icp(*source, *target, Pose3::Identity(), GetParam(), IcpOptions{});
  EXPECT_TRUE(result.target_T_source.matrix().allFinite());
  EXPECT_NEAR(result.target_T_source.translation().z(), -0.1, 0.01);
}

TEST(Icp, InformationIsTheSumOfPointToPlaneJacobiansAboutThePivot) {
  // One horizontal plane: h = [n, lever x n] with n = z.
  std::vector<Eigen::Vector3f> plane;
  for (int i = -10; i <= 10; ++i)
    for (int j = -10; j <= 10; ++j) plane.emplace_back(3 + 0.2f * i, 0.2f * j, -1.0f);
  const auto scan = prepareScan(plane, 8, false);
  const IcpResult result = icp(*scan, *scan, Pose3::Identity(), IcpMetric::kPointToPlane, {});
  EXPECT_LT((result.pivot - Eigen::Vector3d(3, 0, -1)).norm(), 1e-6);
  EXPECT_NEAR(result.weights, static_cast<double>(plane.size()), 1e-6);
  Matrix6d expected = Matrix6d::Zero();
  for (const auto& p : plane) {
    Vector6d h = Vector6d::Zero();
    h[2] = 1;
    h[3] = p.y();
    h[4] = 3.0 - p.x();
    expected += h * h.transpose();
  }
  EXPECT_LT((result.information - expected).norm(), 1e-3 * expected.norm());
}

TEST_P(IcpMetrics, WorksTenKilometresFromTheOrigin) {
  const Pose3 there = Pose3(Eigen::Translation3d(10000, -10000, 50));
  const Pose3 motion = expSE3(tangent(0.3, -0.2, 0.1, 0.01, -0.02, 0.05));
  const auto target = prepareScan(moved(roomPoints(4000, 0.01f, 1), there), 10, false);
  const auto source = prepareScan(moved(roomPoints(4000, 0.01f, 2), there * motion), 10, false);
  const IcpResult result = icp(*source, *target, Pose3::Identity(), GetParam(), {});
  ASSERT_TRUE(result.converged);
  const Pose3 truth = there * motion.inverse() * there.inverse();
  const Eigen::Vector3d room = there.translation();
  EXPECT_LT((result.target_T_source * room - truth * room).norm(), 0.05);
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

TEST(KdTree, FindsWhatBruteForceFinds) {
  const auto points = roomPoints(500, 0.1f, 3);
  const auto queries = roomPoints(100, 1.0f, 4);
  const KdTree tree(points);
  for (const auto& query : queries) {
    size_t best = 0;
    for (size_t i = 1; i < points.size(); ++i)
      if ((points[i] - query).squaredNorm() < (points[best] - query).squaredNorm()) best = i;
    const float distance = (points[best] - query).norm();
    float squared = -1;
    EXPECT_EQ(tree.nearest(query, distance * 1.01f, squared), best);
    EXPECT_NEAR(std::sqrt(squared), distance, 1e-5);
    EXPECT_EQ(tree.nearest(query, distance * 0.99f, squared), KdTree::kNone);
  }
}

TEST(PreparedScan, NormalsOfARoomPointAlongItsAxes) {
  const auto scan = prepareScan(roomPoints(6000, 0.0f, 1), 10, false);
  size_t aligned = 0;
  for (const auto& normal : scan->normals())
    aligned += normal.cwiseAbs().maxCoeff() > 0.99f ? 1 : 0;
  EXPECT_GT(aligned, scan->size() * 8 / 10);
}

TEST(PreparedScan, PlanarNormalsLieInThePlane) {
  const auto scan = prepareScan(planarRoomPoints(600, 0.005f, 1), 6, true);
  for (const auto& normal : scan->normals()) EXPECT_EQ(normal.z(), 0.0f);
}

}  // namespace
}  // namespace lamp
