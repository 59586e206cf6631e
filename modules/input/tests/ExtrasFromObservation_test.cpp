#include "lamp/input/ExtrasFromObservation.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationIMU.h>

#include <limits>

#include "RecordingTools.h"

namespace lamp {
namespace {

using namespace mrpt::obs;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

InputObservation input(const CObservation::Ptr& observation, const std::string& label) {
  return {RobotId{0}, label, 12.5, observation};
}

TEST(ExtrasFromObservation, AnInertialUnitIsTurnedToTheBase) {
  auto imu = CObservationIMU::Create();
  imu->sensorPose = mrpt::poses::CPose3D(1, 2, 3, M_PI / 2, 0, 0);
  EXPECT_FALSE(inertialFromObservation(input(imu, "imu"))) << "it has measured nothing";
  imu->set(IMU_X_ACC, 1);
  imu->set(IMU_Y_ACC, 0);
  imu->set(IMU_Z_ACC, 9.8);
  EXPECT_FALSE(inertialFromObservation(input(imu, "imu"))) << "it has no gyros";
  for (const auto field : {IMU_WX, IMU_WZ}) imu->set(field, 0);
  imu->set(IMU_WY, 0.5);
  const auto reading = inertialFromObservation(input(imu, "imu"));
  ASSERT_TRUE(reading);
  EXPECT_TRUE(reading->specific_force.isApprox(Eigen::Vector3d(0, 1, 9.8), 1e-9));
  EXPECT_TRUE(reading->angular_velocity.isApprox(Eigen::Vector3d(-0.5, 0, 0), 1e-9));
  imu->set(IMU_WY, kNaN);
  EXPECT_FALSE(inertialFromObservation(input(imu, "imu")));
  imu->set(IMU_WY, 0.5);
  imu->sensorPose = mrpt::poses::CPose3D(0, 0, 0, kNaN, 0, 0);
  EXPECT_FALSE(inertialFromObservation(input(imu, "imu"))) << "who knows how it is mounted?";
}

/** MRPT itself knows where the landmark is. */
TEST(ExtrasFromObservation, SightingsAreWhereMrptSaysTheyAre) {
  auto view = CObservationBearingRange::Create();
  view->sensorLocationOnRobot = mrpt::poses::CPose3D(0.3, -0.1, 0.5, 0.2, -0.1, 0.3);
  view->sensor_std_range = 0.2f;
  view->sensor_std_yaw = 0.01f;
  view->sensor_std_pitch = 0.02f;
  CObservationBearingRange::TMeasurement measured;
  measured.range = 4;
  measured.yaw = 0.7f;
  measured.pitch = -0.3f;
  measured.landmarkID = 7;
  view->sensedData.push_back(measured);
  measured.landmarkID = INVALID_LANDMARK_ID;
  view->sensedData.push_back(measured);
  measured.landmarkID = 8;
  measured.range = 0;
  view->sensedData.push_back(measured);
  measured.range = 4;
  measured.yaw = static_cast<float>(kNaN);
  view->sensedData.push_back(measured);

  const auto sightings = sightingsFromObservation(input(view, "artifact"));
  ASSERT_EQ(sightings.size(), 1u) << "no number, no distance, no direction: no sighting";
  EXPECT_EQ(sightings[0].name, "artifact_7");
  EXPECT_EQ(sightings[0].stamp, 12.5);
  const mrpt::poses::CPose3D along(0, 0, 0, view->sensedData[0].yaw, view->sensedData[0].pitch, 0);
  double x, y, z;
  (view->sensorLocationOnRobot + along).composePoint(4, 0, 0, x, y, z);
  EXPECT_LT((sightings[0].base_p_landmark - Eigen::Vector3d(x, y, z)).norm(), 1e-5);
  EXPECT_LT((sightings[0].base_p_sensor - Eigen::Vector3d(0.3, -0.1, 0.5)).norm(), 1e-9);
  EXPECT_NEAR(sightings[0].sigma_m, 0.2, 1e-6);
  EXPECT_NEAR(sightings[0].sigma_rad, 0.02, 1e-6) << "the larger one";

  view->validCovariances = true;
  view->sensedData[0].covariance.setDiagonal(std::vector<double>{0.25, kNaN, kNaN});
  const auto with_covariance = sightingsFromObservation(input(view, "artifact"));
  EXPECT_NEAR(with_covariance[0].sigma_m, 0.5, 1e-6);
  EXPECT_GT(with_covariance[0].sigma_rad, 0) << "never zero, nor no number";
  EXPECT_TRUE(sightingsFromObservation(input(CObservationIMU::Create(), "imu")).empty());
}

TEST(ExtrasFromObservation, ASightingBeyondAllNumbersIsNone) {
  auto view = CObservationBearingRange::Create();
  mrpt::math::CMatrixDouble33 damaged;
  damaged.setDiagonal(1e308);
  view->sensorLocationOnRobot.setRotationMatrix(damaged);
  CObservationBearingRange::TMeasurement measured;
  measured.landmarkID = 7;
  measured.range = 4;
  view->sensedData.push_back(measured);
  EXPECT_TRUE(sightingsFromObservation(input(view, "artifact")).empty());
}

TEST(ExtrasFromObservation, DistancesOutsideTheSensorsLimitsAreNone) {
  auto ranges = CObservationBeaconRanges::Create();
  ranges->minSensorDistance = 0.5f;
  ranges->maxSensorDistance = 50;
  ranges->stdError = 0;
  for (const auto& [id, distance] :
       {std::pair{3, 12.0}, {4, 0.1}, {5, 60.0}, {6, kNaN}, {-1, 2.0}}) {
    CObservationBeaconRanges::TMeasurement measured;
    measured.beaconID = id < 0 ? INVALID_BEACON_ID : id;
    measured.sensedDistance = static_cast<float>(distance);
    measured.sensorLocationOnRobot = mrpt::poses::CPoint3D(0.1, 0.2, 0.3);
    ranges->sensedData.push_back(measured);
  }
  const auto readings = rangesFromObservation(input(ranges, "uwb"));
  ASSERT_EQ(readings.size(), 1u);
  EXPECT_EQ(readings[0].beacon, 3);
  EXPECT_EQ(readings[0].range_m, 12.0);
  EXPECT_GT(readings[0].sigma_m, 0) << "a recording may state none";
  EXPECT_EQ(readings[0].base_p_antenna, Eigen::Vector3d(0.1, 0.2, 0.3));
}

}  // namespace
}  // namespace lamp
