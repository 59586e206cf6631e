#include "lamp/simulation/SensorObservations.h"

#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationWirelessPower.h>

#include <algorithm>

#include "MrptConversions.h"
#include "lamp/core/GraphFiles.h"

namespace lamp::simulation {

using namespace mrpt::obs;

namespace {

/** A camera's view without any artifact in it. */
CObservationBearingRange::Ptr emptyView(const mrpt::Clock::time_point& stamp,
                                        const ArtifactOptions& options, const std::string& robot) {
  const auto angle_sigma = static_cast<float>(options.angle_sigma_deg * M_PI / 180.0);
  auto observation = CObservationBearingRange::Create();
  observation->sensorLabel = robot + "/artifact";
  observation->timestamp = stamp;
  observation->sensorLocationOnRobot = mrpt::poses::CPose3D(0, 0, options.camera_m, 0, 0, 0);
  observation->maxSensorDistance = static_cast<float>(options.range_m);
  observation->sensor_std_range = static_cast<float>(options.range_sigma_m);
  observation->sensor_std_yaw = observation->sensor_std_pitch = angle_sigma;
  return observation;
}

}  // namespace

std::shared_ptr<CObservationRobotPose> odometryObservation(const SimulatedOdometry& odometry,
                                                           size_t index, const std::string& robot) {
  const StampedPose& sample = odometry.odom_T_base.at(index);
  const Matrix6d covariance = covarianceToMrpt(sample.pose, odometry.covariances.at(index));
  auto observation = CObservationRobotPose::Create();
  observation->sensorLabel = robot + "/odom";
  observation->timestamp = stampToMrpt(sample.stamp);
  observation->pose.mean = poseToMrpt(sample.pose);
  for (int row = 0; row < 6; ++row)
    for (int col = 0; col < 6; ++col) observation->pose.cov(row, col) = covariance(row, col);
  return observation;
}

std::shared_ptr<CObservationIMU> imuObservation(const ImuReading& reading,
                                                const std::string& robot) {
  auto observation = CObservationIMU::Create();
  observation->sensorLabel = robot + "/imu";
  observation->timestamp = stampToMrpt(reading.stamp);
  observation->set(IMU_X_ACC, reading.specific_force.x());
  observation->set(IMU_Y_ACC, reading.specific_force.y());
  observation->set(IMU_Z_ACC, reading.specific_force.z());
  observation->set(IMU_WX, reading.angular_velocity.x());
  observation->set(IMU_WY, reading.angular_velocity.y());
  observation->set(IMU_WZ, reading.angular_velocity.z());
  return observation;
}

std::shared_ptr<CObservationWirelessPower> rssiObservation(const RssiReading& reading,
                                                           const Beacon& beacon,
                                                           const std::string& robot,
                                                           double antenna_m) {
  auto observation = CObservationWirelessPower::Create();
  observation->sensorLabel = robot + "/beacon_" + beacon.name;
  observation->timestamp = stampToMrpt(reading.stamp);
  observation->sensorPoseOnRobot = mrpt::poses::CPose3D(0, 0, antenna_m, 0, 0, 0);
  observation->power = std::clamp(100.0 - reading.path_loss_db, 0.0, 100.0);
  return observation;
}

std::vector<std::shared_ptr<CObservationBearingRange>> artifactObservations(
    const std::vector<Sighting>& sightings, const ArtifactOptions& options,
    const std::string& robot) {
  std::vector<std::shared_ptr<CObservationBearingRange>> observations;
  for (const Sighting& sighting : sightings) {
    const auto stamp = stampToMrpt(sighting.stamp);
    if (observations.empty() || observations.back()->timestamp != stamp)
      observations.push_back(emptyView(stamp, options, robot));
    CObservationBearingRange::TMeasurement measurement;
    measurement.range = static_cast<float>(sighting.range_m);
    measurement.yaw = static_cast<float>(sighting.yaw_rad);
    measurement.pitch = static_cast<float>(sighting.pitch_rad);
    measurement.landmarkID = sighting.id;
    measurement.covariance.setZero();  // not used, but written
    observations.back()->sensedData.push_back(measurement);
  }
  return observations;
}

}  // namespace lamp::simulation
