#include "lamp/input/OdometryFromObservation.h"

#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include "MrptPoses.h"
#include "lamp/core/GraphFiles.h"

namespace lamp {
namespace {

using mrpt::obs::CObservationOdometry;
using mrpt::obs::CObservationRobotPose;

std::optional<Matrix6d> tangentCovariance(const Pose3& pose,
                                          const mrpt::math::CMatrixDouble66& xyz_ypr) {
  Matrix6d recorded;
  for (int row = 0; row < 6; ++row) {
    for (int col = 0; col < 6; ++col) recorded(row, col) = xyz_ypr(row, col);
  }
  if (!isCovariance(recorded)) return {};
  const Matrix6d covariance = covarianceFromMrpt(pose, recorded);
  if (!isCovariance(covariance)) return {};
  return covariance;
}

OdometryReading fromRobotPose(const CObservationRobotPose& observation) {
  const Pose3 odom_T_sensor = poseFromMrpt(observation.pose.mean);
  const Pose3 sensor_T_base = poseFromMrpt(observation.sensorPose).inverse();
  OdometryReading reading;
  reading.odom_T_base = odom_T_sensor * sensor_T_base;
  if (!isFinite(reading.odom_T_base)) return reading;
  if (const auto at_sensor = tangentCovariance(odom_T_sensor, observation.pose.cov)) {
    reading.covariance = composeCovariance(*at_sensor, sensor_T_base, Matrix6d::Zero());
  }
  return reading;
}

OdometryReading fromWheels(const CObservationOdometry& observation) {
  OdometryReading reading;
  reading.odom_T_base = poseFromMrpt(observation.odometry);
  reading.planar = true;
  return reading;
}

}  // namespace

bool isOdometry(const mrpt::obs::CObservation& observation) {
  return dynamic_cast<const CObservationOdometry*>(&observation) ||
         dynamic_cast<const CObservationRobotPose*>(&observation);
}

std::optional<OdometryReading> odometryFromObservation(const mrpt::obs::CObservation& observation) {
  OdometryReading reading;
  if (const auto* pose = dynamic_cast<const CObservationRobotPose*>(&observation)) {
    reading = fromRobotPose(*pose);
  } else if (const auto* wheels = dynamic_cast<const CObservationOdometry*>(&observation)) {
    reading = fromWheels(*wheels);
  } else {
    return {};
  }
  if (!isFinite(reading.odom_T_base)) return {};
  reading.stamp = mrpt::Clock::toDouble(observation.timestamp);
  return reading;
}

}  // namespace lamp
