#include "lamp/core/ScanOverlap.h"

#include <gtest/gtest.h>

#include <limits>

#include "TestSupport.h"

namespace lamp {
namespace {

using Points = std::vector<Eigen::Vector3f>;

/** A wall of 4 m x 2 m in the x-z plane, one point in the middle of each 0.2 m voxel. */
Points wall() {
  Points points;
  for (int i = 0; i < 20; ++i)
    for (int k = 0; k < 10; ++k) points.emplace_back(0.2f * i + 0.1f, 0.1f, 0.2f * k + 0.1f);
  return points;
}

Points moved(const Points& points, const Pose3& T) {
  Points result;
  for (const auto& p : points) result.push_back(T.cast<float>() * p);
  return result;
}

Pose3 shift(double x, double y, double z) {
  return Pose3(Eigen::Translation3d(x, y, z));
}

TEST(ScanOverlap, WallsThatAreShiftedAlongThemselves) {
  const OverlapScan a(wall(), false);
  EXPECT_EQ(a.size(), 200u);
  EXPECT_DOUBLE_EQ(scanOverlap(a, a, Pose3::Identity()), 1);
  // 15 of 20 columns lie on the other wall, a sixteenth within 0.3 m of its end.
  EXPECT_NEAR(scanOverlap(a, a, shift(1, 0, 0)), 16.0 / 20, 1e-9);
  EXPECT_NEAR(scanOverlap(a, a, shift(3.8, 0, 0)), 2.0 / 20, 1e-9);
  EXPECT_EQ(scanOverlap(a, a, shift(4.2, 0, 0)), 0);
}

TEST(ScanOverlap, PartnersAreNearerThan30Centimetres) {
  const OverlapScan a(wall(), false);
  EXPECT_DOUBLE_EQ(scanOverlap(a, a, shift(0, 0.29, 0)), 1);
  EXPECT_EQ(scanOverlap(a, a, shift(0, 0.31, 0)), 0);
}

TEST(ScanOverlap, NormalsAgreeWithin45Degrees) {
  // Rotated about the middle of the wall, which therefore stays within reach near the axis.
  const Pose3 to_middle = shift(2, 0.1, 1);
  const auto turned = [&](double degrees) {
    return to_middle * Eigen::AngleAxisd(degrees * M_PI / 180, Eigen::Vector3d::UnitX()) *
           to_middle.inverse();
  };
  const OverlapScan a(wall(), false);
  EXPECT_GT(scanOverlap(a, a, turned(44)), 0.2);
  EXPECT_EQ(scanOverlap(a, a, turned(46)), 0);
  EXPECT_GT(scanOverlap(a, a, turned(180)), 0.9) << "a normal has no side";
}

TEST(ScanOverlap, IsTheSmallerShareWhicheverComesFirst) {
  Points large = wall();
  for (const auto& p : moved(wall(), shift(8, 0, 0))) large.push_back(p);
  const OverlapScan a(wall(), false), b(large, false);
  EXPECT_NEAR(scanOverlap(a, b, Pose3::Identity()), 0.5, 1e-9);
  EXPECT_NEAR(scanOverlap(b, a, Pose3::Identity()), 0.5, 1e-9);
  const Pose3 T = shift(0.7, 0.1, -0.2);
  EXPECT_DOUBLE_EQ(scanOverlap(a, b, T), scanOverlap(b, a, T.inverse()));
}

TEST(ScanOverlap, DoesNotDependOnTheFrameOfTheScans) {
  test::Random random;
  const Pose3 true_shift = shift(1, 0, 0), world_T_a = random.pose(), world_T_b = random.pose();
  const OverlapScan a(moved(wall(), world_T_a), false), b(moved(wall(), world_T_b), false);
  EXPECT_NEAR(scanOverlap(a, b, world_T_a * true_shift * world_T_b.inverse()), 16.0 / 20, 0.05);
}

TEST(ScanOverlap, DenseAndSparseScansOfOneWallOverlap) {
  Points dense;
  for (int i = 0; i < 80; ++i)
    for (int k = 0; k < 40; ++k) dense.emplace_back(0.05f * i, 0.1f, 0.05f * k);
  EXPECT_DOUBLE_EQ(
      scanOverlap(OverlapScan(dense, false), OverlapScan(wall(), false), Pose3::Identity()), 1);
}

TEST(ScanOverlap, PlanarScansHaveNormalsInThePlane) {
  Points line;
  for (int i = 0; i < 50; ++i) line.emplace_back(0.2f * i + 0.1f, 0.1f, 0);
  const OverlapScan a(line, true);
  // 45 of 50 points and one within 0.3 m of the end.
  EXPECT_NEAR(scanOverlap(a, a, shift(1, 0, 0)), 46.0 / 50, 1e-9);
  EXPECT_EQ(scanOverlap(a, a, planarPose(5, -5, M_PI / 2)), 0)
      << "the lines cross at a right angle";
}

TEST(ScanOverlap, EmptyTinyAndNotFiniteScansOverlapWithNothing) {
  const OverlapScan a(wall(), false), empty({}, false), one({{1.1f, 0.1f, 1.1f}}, false);
  EXPECT_EQ(scanOverlap(a, empty, Pose3::Identity()), 0);
  EXPECT_EQ(scanOverlap(empty, a, Pose3::Identity()), 0);
  EXPECT_EQ(scanOverlap(one, one, Pose3::Identity()), 0) << "one point has no normal";
  Points with_nan = wall();
  with_nan.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0, 0);
  EXPECT_EQ(OverlapScan(with_nan, false).size(), 200u);
}

}  // namespace
}  // namespace lamp
