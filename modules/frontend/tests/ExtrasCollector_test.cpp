#include "lamp/frontend/ExtrasCollector.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationIMU.h>

#include "TestObservations.h"
#include "lamp/frontend/RecordedOdometry.h"

namespace lamp {
namespace {

using namespace test;

/** A landmark straight ahead. */
InputObservation sighting(double stamp, int number, double range) {
  auto view = mrpt::obs::CObservationBearingRange::Create();
  view->sensor_std_range = 0.1f;
  view->sensor_std_yaw = view->sensor_std_pitch = 0.01f;
  mrpt::obs::CObservationBearingRange::TMeasurement measured;
  measured.range = static_cast<float>(range);
  measured.yaw = measured.pitch = 0;
  measured.landmarkID = number;
  view->sensedData.push_back(measured);
  return wrapped(stamp, "artifact", view);
}

InputObservation distance(double stamp, int beacon, double range) {
  auto ranges = mrpt::obs::CObservationBeaconRanges::Create();
  mrpt::obs::CObservationBeaconRanges::TMeasurement measured;
  measured.beaconID = beacon;
  measured.sensedDistance = static_cast<float>(range);
  measured.sensorLocationOnRobot = mrpt::poses::CPoint3D(0.5, 0, 0);
  ranges->sensedData.push_back(measured);
  return wrapped(stamp, "uwb", ranges);
}

/** A robot that drives ahead at 1 m/s. */
class ExtrasCollectorTest : public testing::Test {
 protected:
  ExtrasCollectorTest() {
    for (int i = 0; i <= 10; ++i) odometry.observe(wheels(kStart + i, i));
  }
  void observe(const InputObservation& observation) { collector.observe(observation); }

  RecordedOdometry odometry;
  ExtrasCollector collector{GravityOptions{}};
};

TEST_F(ExtrasCollectorTest, OdometryCarriesReadingsToTheKeyNode) {
  observe(sighting(kStart + 2, 4, 6.0));
  observe(distance(kStart + 3, 9, 7.0));
  collector.advanceTo(kStart + 5, odometry);
  const KeyNodeExtras extras = collector.take(odometry.poseAt(kStart + 5));
  ASSERT_EQ(extras.sightings.size(), 1u);
  EXPECT_EQ(extras.sightings[0].name, "artifact_4");
  EXPECT_LT((extras.sightings[0].base_p_landmark - Eigen::Vector3d(3, 0, 0)).norm(), 1e-6)
      << "6 m ahead of where it was 3 m ago";
  EXPECT_LT((extras.sightings[0].base_p_sensor - Eigen::Vector3d(-3, 0, 0)).norm(), 1e-6);
  ASSERT_EQ(extras.ranges.size(), 1u);
  EXPECT_LT((extras.ranges[0].base_p_antenna - Eigen::Vector3d(-1.5, 0, 0)).norm(), 1e-6);
  EXPECT_FALSE(extras.gravity);
  EXPECT_TRUE(collector.take(Pose3::Identity()).sightings.empty()) << "each is sent once";
}

TEST_F(ExtrasCollectorTest, KeepsTheNearestSightingAndTheLastDistance) {
  for (const double range : {5.0, 3.0, 4.0}) observe(sighting(kStart + 8 - range, 4, range));
  for (const double range : {5.0, 3.0, 4.0}) observe(distance(kStart + 8 - range, 9, range));
  observe(distance(kStart + 5, 2, 1.0));
  collector.advanceTo(kStart + 6, odometry);
  const KeyNodeExtras extras = collector.take(odometry.poseAt(kStart + 6));
  ASSERT_EQ(extras.sightings.size(), 1u);
  EXPECT_NEAR((extras.sightings[0].base_p_landmark - extras.sightings[0].base_p_sensor).norm(), 3,
              1e-6);
  ASSERT_EQ(extras.ranges.size(), 2u);
  EXPECT_EQ(extras.ranges[0].beacon, 2) << "in the order of their numbers";
}

TEST_F(ExtrasCollectorTest, ReadingsAfterTheStampWait) {
  observe(sighting(kStart + 6, 4, 6.0));
  collector.advanceTo(kStart + 5, odometry);
  EXPECT_TRUE(collector.take(Pose3::Identity()).sightings.empty());
  collector.advanceTo(kStart + 7, odometry);
  EXPECT_EQ(collector.take(Pose3::Identity()).sightings.size(), 1u);
}

TEST_F(ExtrasCollectorTest, WhatOdometryDoesNotCoverIsDropped) {
  observe(sighting(kStart + 60, 4, 6.0));
  collector.advanceTo(kStart + 100, odometry);
  EXPECT_TRUE(collector.take(Pose3::Identity()).sightings.empty());
  RecordedOdometry nothing;
  observe(sighting(kStart + 2, 4, 6.0));
  collector.advanceTo(kStart + 100, nothing);
  EXPECT_TRUE(collector.take(Pose3::Identity()).sightings.empty());
}

TEST_F(ExtrasCollectorTest, GravityTurnsWithTheRobot) {
  RecordedOdometry turning;
  for (int i = 0; i <= 10; ++i)
    turning.observe(
        robotPose(kStart + i, poseFromYawPitchRoll(tangent(0, 0, 0, 0, i < 5 ? 0 : 0.3, 0))));
  for (int i = 0; i < 300; ++i) {
    auto imu = mrpt::obs::CObservationIMU::Create();
    for (const auto& [field, value] : {std::pair{mrpt::obs::IMU_X_ACC, 0.0},
                                       {mrpt::obs::IMU_Y_ACC, 0.0},
                                       {mrpt::obs::IMU_Z_ACC, 9.8},
                                       {mrpt::obs::IMU_WX, 0.0},
                                       {mrpt::obs::IMU_WY, 0.0},
                                       {mrpt::obs::IMU_WZ, 0.0}})
      imu->set(field, value);
    observe(wrapped(kStart + 1 + 0.01 * i, "imu", imu));
  }
  collector.advanceTo(kStart + 6, turning);
  const KeyNodeExtras extras = collector.take(turning.poseAt(kStart + 6));
  ASSERT_TRUE(extras.gravity);
  const Eigen::Vector3d expected =
      turning.poseAt(kStart + 6).linear().transpose() * Eigen::Vector3d::UnitZ();
  EXPECT_LT((extras.gravity->base_up - expected).norm(), 1e-6);
}

}  // namespace
}  // namespace lamp
