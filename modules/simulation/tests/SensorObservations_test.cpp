#include "lamp/simulation/SensorObservations.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationWirelessPower.h>

#include "TestMotion.h"
#include "lamp/core/GraphFiles.h"

namespace lamp::simulation {
namespace {

using namespace test;

Matrix6d fromMrpt(const mrpt::math::CMatrixDouble66& m) {
  Matrix6d result;
  for (int row = 0; row < 6; ++row)
    for (int col = 0; col < 6; ++col) result(row, col) = m(row, col);
  return result;
}

/** Growth of the covariance between two observations, read back as the front end does. */
Matrix6d growth(const mrpt::obs::CObservationRobotPose& a, const Pose3& odom_T_a,
                const mrpt::obs::CObservationRobotPose& b, const Pose3& odom_T_b) {
  const Matrix6d at_a = covarianceFromMrpt(odom_T_a, fromMrpt(a.pose.cov));
  const Matrix6d at_b = covarianceFromMrpt(odom_T_b, fromMrpt(b.pose.cov));
  return at_b - composeCovariance(at_a, odom_T_a.inverse() * odom_T_b, Matrix6d::Zero());
}

TEST(SensorObservations, OdometryKeepsItsPoseAndTheGrowthOfItsCovariance) {
  const auto odometry = simulateOdometry(winding(2000), {}, 1);
  const size_t last = odometry.odom_T_base.size() - 1;
  const auto a = odometryObservation(odometry, last - 20, "husky1");
  const auto b = odometryObservation(odometry, last, "husky1");
  const Pose3 &odom_T_a = odometry.odom_T_base[last - 20].pose,
              &odom_T_b = odometry.odom_T_base[last].pose;
  EXPECT_EQ(b->sensorLabel, "husky1/odom");
  EXPECT_NEAR(mrpt::Clock::toDouble(b->timestamp), odometry.odom_T_base[last].stamp, 1e-6);
  EXPECT_NEAR(b->pose.mean.x(), odom_T_b.translation().x(), 1e-9);
  EXPECT_NEAR(b->pose.mean.yaw(), yawOf(odom_T_b), 1e-9);
  const Matrix6d direct = odometry.covariances[last] -
                          composeCovariance(odometry.covariances[last - 20],
                                            odom_T_a.inverse() * odom_T_b, Matrix6d::Zero());
  const Matrix6d read = growth(*a, odom_T_a, *b, odom_T_b);
  EXPECT_TRUE(isCovariance(0.5 * (read + read.transpose()))) << "after 2 km, over 2 m";
  EXPECT_TRUE(read.diagonal().isApprox(direct.diagonal(), 1e-3));
}

TEST(SensorObservations, ImuUsesMrptsIndices) {
  const auto o = imuObservation({kBegin, {1, 2, 3}, {4, 5, 6}}, "husky1");
  EXPECT_EQ(o->sensorLabel, "husky1/imu");
  EXPECT_EQ(o->get(mrpt::obs::IMU_WX), 1);
  EXPECT_EQ(o->get(mrpt::obs::IMU_PITCH_VEL), 2);
  EXPECT_EQ(o->get(mrpt::obs::IMU_YAW_VEL), 3);
  EXPECT_EQ(o->get(mrpt::obs::IMU_X_ACC), 4);
  EXPECT_EQ(o->get(mrpt::obs::IMU_Z_ACC), 6);
  EXPECT_FALSE(o->has(mrpt::obs::IMU_YAW));
}

TEST(SensorObservations, PowerIsAHundredLessThePathLoss) {
  const Beacon beacon{"husky2-3", {0, 0, 0}, 0};
  const auto o = rssiObservation({kBegin, 0, 58.5}, beacon, "husky1", 0.4);
  EXPECT_EQ(o->sensorLabel, "husky1/beacon_husky2-3");
  EXPECT_NEAR(o->power, 41.5, 1e-9);
  EXPECT_EQ(rssiObservation({kBegin, 0, 120}, beacon, "husky1", 0.4)->power, 0);
}

TEST(SensorObservations, AnArtifactIsALandmark) {
  const Sighting sighting{kBegin, 7, 5.0, 0.3, 0.1};
  const auto all = artifactObservations({sighting}, {}, "husky1");
  ASSERT_EQ(all.size(), 1u);
  const auto& o = all[0];
  EXPECT_EQ(o->sensorLabel, "husky1/artifact");
  ASSERT_EQ(o->sensedData.size(), 1u);
  EXPECT_EQ(o->sensedData[0].landmarkID, 7);
  EXPECT_FLOAT_EQ(o->sensedData[0].range, 5.0f);
  // MRPT's own reading of the angles: along x of a pose with this yaw and pitch.
  const auto p = (mrpt::poses::CPose3D(0, 0, 0, o->sensedData[0].yaw, o->sensedData[0].pitch, 0))
                     .composePoint({5.0, 0, 0});
  EXPECT_LT(p.z, 0) << "a positive pitch is below the camera";
}

TEST(SensorObservations, WhatIsSeenAtOneStampIsOneObservation) {
  const auto all = artifactObservations(
      {{kBegin, 7, 5.0, 0.3, 0.1}, {kBegin, 8, 6.0, 0, 0}, {kBegin + 1, 7, 4.0, 0, 0}}, {}, "r");
  ASSERT_EQ(all.size(), 2u);
  ASSERT_EQ(all[0]->sensedData.size(), 2u);
  EXPECT_EQ(all[0]->sensedData[1].landmarkID, 8);
  EXPECT_EQ(all[1]->sensedData.size(), 1u);
}

}  // namespace
}  // namespace lamp::simulation
