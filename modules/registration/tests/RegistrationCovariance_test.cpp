#include <gtest/gtest.h>

#include "TestScans.h"

namespace lamp {
namespace {

using namespace test;

/** Numbers that are easy to calculate with by hand. */
RegistrationCovarianceOptions plainOptions() {
  RegistrationCovarianceOptions options;
  options.sigma_m = 0.1;
  options.correlated_points = 4;  // variance of a measurement: 0.01 * 4 = 0.04
  options.floor_sigma_m = 0.03;
  options.floor_sigma_deg = 2.0;
  options.max_sigma_m = 0.5;
  return options;
}
constexpr double kVariance = 0.04;
constexpr double kFloorM = 0.03 * 0.03;
const double kFloorRad = std::pow(2.0 * kDegree, 2);
constexpr double kMaxVariance = 0.25;

/** Information of points with their normals: sum of h hᵀ with h = [n, p × n]. */
Matrix6d informationOf(const Points& points, const Points& normals) {
  Matrix6d A = Matrix6d::Zero();
  for (size_t i = 0; i < points.size(); ++i) {
    Vector6d h;
    h << normals[i].cast<double>(), points[i].cross(normals[i]).cast<double>();
    A += h * h.transpose();
  }
  return A;
}

/** A tunnel with a square profile, infinitely smooth, along the unit vector `axis`. */
Matrix6d tunnelInformation(const Eigen::Vector3f& axis) {
  const Eigen::Quaternionf R = Eigen::Quaternionf::FromTwoVectors(Eigen::Vector3f::UnitX(), axis);
  Points points, normals;
  for (float x = -5; x <= 5; x += 0.5f)
    for (float s = -1.5f; s <= 1.5f; s += 0.25f)
      for (const float side : {-1.5f, 1.5f}) {
        points.push_back(R * Eigen::Vector3f(x, side, s));
        normals.push_back(R * Eigen::Vector3f::UnitY());
        points.push_back(R * Eigen::Vector3f(x, s, side));
        normals.push_back(R * Eigen::Vector3f::UnitZ());
      }
  return informationOf(points, normals);
}

TEST(RegistrationCovariance, IsTheScaledInversePlusTheFloorWhereWellObserved) {
  const Vector6d information = tangent(100, 200, 400, 800, 1000, 500);
  const Matrix6d covariance =
      registrationCovariance(information.asDiagonal(), plainOptions(), false);
  Matrix6d expected = Matrix6d::Zero();
  for (int i = 0; i < 6; ++i)
    expected(i, i) = kVariance / information[i] + (i < 3 ? kFloorM : kFloorRad);
  EXPECT_LT((covariance - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(RegistrationCovariance, KeepsCorrelations) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Matrix6d root;
  for (int i = 0; i < 36; ++i) root(i / 6, i % 6) = normal(random);
  const Matrix6d information = 50 * (root * root.transpose() + Matrix6d::Identity());
  Matrix6d expected = kVariance * information.inverse();
  expected.diagonal().head<3>().array() += kFloorM;
  expected.diagonal().tail<3>().array() += kFloorRad;
  const Matrix6d covariance = registrationCovariance(information, plainOptions(), false);
  EXPECT_LT((covariance - expected).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GT(expected.cwiseAbs()(0, 4), 1e-6) << "the example must have correlations";
}

TEST(RegistrationCovariance, GivesTheLargestSigmaAlongATunnel) {
  for (const Eigen::Vector3f& axis :
       {Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, 1, 0), Eigen::Vector3f(1, 2, -1)}) {
    const Eigen::Vector3d along = axis.normalized().cast<double>();
    const Matrix6d covariance =
        registrationCovariance(tunnelInformation(axis.normalized()), plainOptions(), false);
    ASSERT_TRUE(isCovariance(covariance));
    const Eigen::Matrix3d position = covariance.topLeftCorner<3, 3>();
    EXPECT_NEAR(along.dot(position * along), kMaxVariance + kFloorM, 1e-4);
    const Eigen::Vector3d across = along.unitOrthogonal();
    EXPECT_LT(across.dot(position * across), 2 * kFloorM) << "the walls hold it across";
    EXPECT_LT(covariance.diagonal().tail<3>().maxCoeff(), 2 * kFloorRad);
  }
}

TEST(RegistrationCovariance, GivesNothingMoreThanTheLargestSigma) {
  const Vector6d hardly = tangent(1e-6, 100, 100, 100, 100, 100);
  EXPECT_NEAR(registrationCovariance(hardly.asDiagonal(), plainOptions(), false)(0, 0),
              kMaxVariance + kFloorM, 1e-12);
  // A round number of information that lies just above and just below the limit 0.04 / 0.25.
  const Vector6d above = tangent(0.2, 100, 100, 100, 100, 100);
  EXPECT_NEAR(registrationCovariance(above.asDiagonal(), plainOptions(), false)(0, 0),
              0.2 + kFloorM, 1e-12);
}

TEST(RegistrationCovariance, IsUsableWithoutAnyInformation) {
  for (const bool planar : {false, true}) {
    const Matrix6d covariance = registrationCovariance(Matrix6d::Zero(), plainOptions(), planar);
    EXPECT_TRUE(isCovariance(covariance));
    for (const int i : {0, 1})
      EXPECT_NEAR(covariance(i, i), kMaxVariance + kFloorM, 1e-12) << planar;
    EXPECT_NEAR(covariance(5, 5), kMaxVariance + kFloorRad, 1e-12) << planar;
  }
}

TEST(RegistrationCovariance, UsesOnlyTheAxesOfThePlane) {
  // Wildly wrong numbers on the other axes, coupled with those of the plane, must not matter.
  Matrix6d information = Matrix6d::Zero();
  Eigen::Matrix3d plane;
  plane << 100, 10, 5, 10, 300, -20, 5, -20, 900;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) information(kPlanarAxes[i], kPlanarAxes[j]) = plane(i, j);
  for (const int other : {2, 3, 4}) information(other, 0) = information(0, other) = 77;
  const Eigen::Matrix3d inverse = kVariance * plane.inverse();
  const Matrix6d covariance = registrationCovariance(information, plainOptions(), true);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double floor = i != j ? 0 : i < 2 ? kFloorM : kFloorRad;
      EXPECT_NEAR(covariance(kPlanarAxes[i], kPlanarAxes[j]), inverse(i, j) + floor, 1e-12);
    }
  EXPECT_TRUE(isCovariance(covariance));
  for (const int other : {2, 3, 4})
    for (const int axis : kPlanarAxes) EXPECT_EQ(covariance(other, axis), 0.0);
}

TEST(RegistrationCovariance, PlanarCorridorIsUnobservedAlongItself) {
  Points points, normals;
  for (float x = -5; x <= 5; x += 0.1f)
    for (const float y : {-1.0f, 1.0f}) {
      points.emplace_back(x, y, 0);
      normals.emplace_back(0, 1, 0);
    }
  const Matrix6d covariance =
      registrationCovariance(informationOf(points, normals), plainOptions(), true);
  EXPECT_NEAR(covariance(0, 0), kMaxVariance + kFloorM, 1e-9);
  EXPECT_LT(covariance(1, 1), kFloorM + 1e-3);
  EXPECT_LT(covariance(5, 5), kFloorRad + 1e-3);
}

TEST(RegistrationCovariance, MoreCorrelatedPointsKnowLess) {
  RegistrationCovarianceOptions few = plainOptions(), many = plainOptions();
  many.correlated_points = 10 * few.correlated_points;
  const Matrix6d information = 1000 * Matrix6d::Identity();
  const double of_few = registrationCovariance(information, few, false)(0, 0) - kFloorM;
  const double of_many = registrationCovariance(information, many, false)(0, 0) - kFloorM;
  EXPECT_NEAR(of_many, 10 * of_few, 1e-12);
}

}  // namespace
}  // namespace lamp
