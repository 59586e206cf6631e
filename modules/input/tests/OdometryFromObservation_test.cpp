#include "lamp/input/OdometryFromObservation.h"

#include <gtest/gtest.h>

#include <limits>

#include "RecordingTools.h"

namespace lamp {
namespace {

using namespace test;

mrpt::obs::CObservationRobotPose robotPose(const mrpt::poses::CPose3D& mean) {
  mrpt::obs::CObservationRobotPose o;
  o.timestamp = mrpt::Clock::fromDouble(12.5);
  o.pose.mean = mean;
  return o;
}

TEST(OdometryFromObservation, WheelsArePlanar) {
  auto o = wheels(3.5, "odo", 2);
  o->odometry = mrpt::poses::CPose2D(1, 2, 0.3);
  const auto reading = odometryFromObservation(*o);
  ASSERT_TRUE(reading);
  EXPECT_TRUE(reading->planar);
  EXPECT_EQ(reading->stamp, 3.5);
  EXPECT_FALSE(reading->covariance);
  EXPECT_TRUE(reading->odom_T_base.isApprox(planarPose(1, 2, 0.3), 1e-12));
}

TEST(OdometryFromObservation, PoseOfAMountedSensorIsCarriedToTheBase) {
  // The tracker sits 1 m ahead of the base and looks left; the base stands at (5, 0), looking
  // ahead.
  auto o = robotPose(mrpt::poses::CPose3D(6, 0, 0.5, M_PI / 2, 0, 0));
  o.sensorPose = mrpt::poses::CPose3D(1, 0, 0.5, M_PI / 2, 0, 0);
  const auto reading = odometryFromObservation(o);
  ASSERT_TRUE(reading);
  EXPECT_FALSE(reading->planar);
  EXPECT_FALSE(reading->covariance) << "an all-zero covariance means that there is none";
  EXPECT_TRUE(reading->odom_T_base.isApprox(planarPose(5, 0, 0), 1e-12));
}

TEST(OdometryFromObservation, CovarianceTurnsAndGrowsWithTheLever) {
  auto o = robotPose(mrpt::poses::CPose3D(0, 0, 0, 0, 0, 0));
  o.pose.cov.setZero();
  for (int i = 0; i < 6; ++i) o.pose.cov(i, i) = 1e-6;
  o.pose.cov(3, 3) = 0.01;  // yaw
  o.sensorPose = mrpt::poses::CPose3D(2, 0, 0, 0, 0, 0);
  const auto reading = odometryFromObservation(o);
  ASSERT_TRUE(reading && reading->covariance);
  // Yaw about the sensor moves the base, 2 m behind it, sideways.
  EXPECT_NEAR((*reading->covariance)(1, 1), 4 * 0.01, 1e-5);
  EXPECT_NEAR((*reading->covariance)(5, 5), 0.01, 1e-9);
  EXPECT_NEAR((*reading->covariance)(0, 0), 1e-6, 1e-9);
}

TEST(OdometryFromObservation, RefusesWhatIsNotFinite) {
  auto o = robotPose(mrpt::poses::CPose3D(std::numeric_limits<double>::quiet_NaN(), 0, 0));
  EXPECT_FALSE(odometryFromObservation(o));
  auto w = wheels(1, "odo");
  w->odometry.x(std::numeric_limits<double>::infinity());
  EXPECT_FALSE(odometryFromObservation(*w));
}

TEST(OdometryFromObservation, UnusableCovarianceIsNone) {
  auto o = robotPose(mrpt::poses::CPose3D(1, 2, 3));
  o.pose.cov.setIdentity();
  o.pose.cov(0, 0) = -1;
  EXPECT_FALSE(odometryFromObservation(o)->covariance);
  o.pose.cov(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(odometryFromObservation(o)->covariance);
}

TEST(OdometryFromObservation, OtherClassesAreNone) {
  EXPECT_FALSE(isOdometry(*cloud(1, "lidar")));
  EXPECT_FALSE(odometryFromObservation(*cloud(1, "lidar")));
  EXPECT_TRUE(isOdometry(*wheels(1, "odo")));
}

}  // namespace
}  // namespace lamp
