#include "lamp/frontend/MotionModel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "TestObservations.h"

namespace lamp {
namespace {

using namespace test;

Path pathOf(double length_m, double turned_rad) {
  Path path;
  path.length_m = length_m;
  path.turned_rad = turned_rad;
  return path;
}

TEST(Path, AddsUpWayAndTurning) {
  Path path;
  path.add(planarPose(3, 4, 0.2));
  path.add(planarPose(-3, -4, -0.2));
  EXPECT_NEAR(path.length_m, 10, 1e-12) << "there and back is a way, too";
  EXPECT_NEAR(path.turned_rad, 0.4, 1e-12);
}

TEST(MotionModel, HasAFloor) {
  const MotionModelOptions options;
  const Matrix6d covariance = odometryCovariance(Path{}, options);
  EXPECT_TRUE(isCovariance(covariance));
  EXPECT_NEAR(std::sqrt(covariance(0, 0)), options.min_sigma_m, 1e-12);
  EXPECT_NEAR(std::sqrt(covariance(5, 5)), options.min_sigma_rad, 1e-12);
}

TEST(MotionModel, GrowsWithTheWayAndTheTurning) {
  MotionModelOptions options;
  options.sigma_m_per_m = 0.03;
  options.min_sigma_m = 0.04;
  options.sigma_rad_per_m = 0.002;
  options.sigma_rad_per_rad = 0.03;
  options.min_sigma_rad = 0.006;
  const Matrix6d covariance = odometryCovariance(pathOf(1.0, 0.1), options);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(std::sqrt(covariance(i, i)), 0.05, 1e-12);
  for (int i = 3; i < 6; ++i) EXPECT_NEAR(std::sqrt(covariance(i, i)), 0.007, 1e-12);
  EXPECT_TRUE(covariance.isDiagonal());

  EXPECT_GT(odometryCovariance(pathOf(2, 0), options)(0, 0),
            odometryCovariance(pathOf(1, 0), options)(0, 0));
  EXPECT_GT(odometryCovariance(pathOf(2, 0), options)(5, 5),
            odometryCovariance(pathOf(1, 0), options)(5, 5));
  EXPECT_GT(odometryCovariance(pathOf(1, 2), options)(5, 5),
            odometryCovariance(pathOf(1, 1), options)(5, 5));
}

}  // namespace
}  // namespace lamp
