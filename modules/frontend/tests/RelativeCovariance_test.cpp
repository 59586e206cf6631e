#include "lamp/frontend/RelativeCovariance.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

namespace lamp {
namespace {

Matrix6d diagonal(double m, double rad) {
  Vector6d v;
  v << m, m, m, rad, rad, rad;
  return v.asDiagonal();
}

const Pose3 kStep = planarPose(1, 0, 0.1);

TEST(RelativeCovariance, AddsUpWhatNobodySees) {
  RelativeCovariance covariance;
  covariance.keep();
  Pose3 motion = Pose3::Identity();
  Matrix6d expected = Matrix6d::Zero();
  for (int i = 0; i < 10; ++i) {
    covariance.predict(kStep, diagonal(1e-4, 1e-6));
    expected = composeCovariance(expected, kStep, diagonal(1e-4, 1e-6));
    motion = motion * kStep;
  }
  EXPECT_TRUE(covariance.sinceKept(motion).isApprox(expected, 1e-9));
}

TEST(RelativeCovariance, MotionSinceAKeyNodeForgetsWhatWasBefore) {
  RelativeCovariance covariance;
  for (int i = 0; i < 100; ++i) covariance.predict(kStep, diagonal(1, 1e-2));
  covariance.keep();
  covariance.predict(kStep, diagonal(1e-4, 1e-6));
  EXPECT_TRUE(covariance.sinceKept(kStep).isApprox(diagonal(1e-4, 1e-6), 1e-6))
      << covariance.sinceKept(kStep).diagonal().transpose();
}

TEST(RelativeCovariance, WhatIsSeenAtBothEndsAddsUp) {
  RelativeCovariance covariance;
  covariance.predict(kStep, diagonal(100, 1));
  covariance.update(diagonal(1e4, 1e6));
  covariance.keep();
  covariance.predict(kStep, diagonal(100, 1));
  covariance.update(diagonal(1e4, 1e6));
  const Matrix6d expected = composeCovariance(diagonal(1e-4, 1e-6), kStep, diagonal(1e-4, 1e-6));
  EXPECT_TRUE(covariance.sinceKept(kStep).isApprox(expected, 1e-3));
}

/** A robot drifts along a tunnel, and sees at its end how far. */
TEST(RelativeCovariance, BeingPulledBackIsAsUncertainAsTheDrift) {
  RelativeCovariance covariance;
  Matrix6d drift = Matrix6d::Zero();
  drift(0, 0) = 0.01;
  const Pose3 step(Eigen::Translation3d(1, 0, 0));
  for (int i = 0; i < 100; ++i) covariance.predict(step, drift);
  EXPECT_NEAR(covariance.pose()(0, 0), 1.0, 1e-9);
  covariance.keep();
  covariance.predict(step, drift);
  Matrix6d seen = Matrix6d::Zero();
  seen(0, 0) = 1e6;
  covariance.update(seen);
  EXPECT_NEAR(covariance.pose()(0, 0), 1e-6, 1e-8);
  EXPECT_NEAR(covariance.sinceKept(step)(0, 0), 1.0, 0.01);
}

TEST(RelativeCovariance, IsNeverNegative) {
  RelativeCovariance covariance;
  for (int i = 0; i < 50; ++i) {
    covariance.keep();
    covariance.predict(kStep, diagonal(i % 3 ? 1e-8 : 1e3, 1e-9));
    covariance.update(diagonal(i % 2 ? 1e9 : 0, 1e3));
    EXPECT_GE(covariance.sinceKept(kStep).selfadjointView<Eigen::Upper>().eigenvalues().minCoeff(),
              -1e-12);
  }
}

}  // namespace
}  // namespace lamp
