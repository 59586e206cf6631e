#include "lamp/input/ExtrasFromObservation.h"

#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationIMU.h>

#include <algorithm>
#include <cmath>

#include "MrptPoses.h"

namespace lamp {

using namespace mrpt::obs;

namespace {

constexpr double kLeastSigmaM = 0.01;
constexpr double kLeastSigmaRad = 0.1 * M_PI / 180.0;

/** MRPT's pitch is the negative elevation. */
Eigen::Vector3d direction(double yaw, double pitch) {
  return {std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), -std::sin(pitch)};
}

}  // namespace

std::optional<InertialReading> inertialFromObservation(const InputObservation& observation) {
  const auto* const imu = dynamic_cast<const CObservationIMU*>(observation.observation.get());
  if (!imu) return std::nullopt;
  for (const TIMUDataIndex field : {IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC, IMU_WX, IMU_WY, IMU_WZ})
    if (!imu->has(field)) return std::nullopt;
  const Eigen::Matrix3d base_R_sensor = poseFromMrpt(imu->sensorPose).linear();
  const Eigen::Vector3d force(imu->get(IMU_X_ACC), imu->get(IMU_Y_ACC), imu->get(IMU_Z_ACC));
  const Eigen::Vector3d turn(imu->get(IMU_WX), imu->get(IMU_WY), imu->get(IMU_WZ));
  const InertialReading reading{base_R_sensor * force, base_R_sensor * turn};
  if (!reading.specific_force.allFinite() || !reading.angular_velocity.allFinite())
    return std::nullopt;
  return reading;
}

std::vector<LandmarkSighting> sightingsFromObservation(const InputObservation& observation) {
  const auto* const view =
      dynamic_cast<const CObservationBearingRange*>(observation.observation.get());
  if (!view) return {};
  const Pose3 base_T_sensor = poseFromMrpt(view->sensorLocationOnRobot);
  if (!isFinite(base_T_sensor)) return {};
  std::vector<LandmarkSighting> sightings;
  for (const auto& seen : view->sensedData) {
    const double range = seen.range;
    if (seen.landmarkID == INVALID_LANDMARK_ID || !std::isfinite(seen.yaw) ||
        !std::isfinite(seen.pitch) || !(range > 0) || !std::isfinite(range))
      continue;
    LandmarkSighting sighting;
    sighting.stamp = observation.stamp;
    sighting.name = observation.label + "_" + std::to_string(seen.landmarkID);
    sighting.base_p_sensor = base_T_sensor.translation();
    sighting.base_p_landmark = base_T_sensor * (range * direction(seen.yaw, seen.pitch));
    if (!sighting.base_p_landmark.allFinite()) continue;
    sighting.sigma_m = view->sensor_std_range;
    sighting.sigma_rad = std::max(view->sensor_std_yaw, view->sensor_std_pitch);
    if (view->validCovariances) {
      sighting.sigma_m = std::sqrt(seen.covariance(0, 0));
      sighting.sigma_rad = std::sqrt(std::max(seen.covariance(1, 1), seen.covariance(2, 2)));
    }
    // In this order a value that is no number becomes the least one.
    sighting.sigma_m = std::max(kLeastSigmaM, sighting.sigma_m);
    sighting.sigma_rad = std::max(kLeastSigmaRad, sighting.sigma_rad);
    sightings.push_back(std::move(sighting));
  }
  return sightings;
}

std::vector<RangeReading> rangesFromObservation(const InputObservation& observation) {
  const auto* const ranges =
      dynamic_cast<const CObservationBeaconRanges*>(observation.observation.get());
  if (!ranges) return {};
  std::vector<RangeReading> readings;
  for (const auto& sensed : ranges->sensedData) {
    const double range = sensed.sensedDistance;
    const bool within =
        range > 0 && range >= ranges->minSensorDistance && range <= ranges->maxSensorDistance;
    if (sensed.beaconID == INVALID_BEACON_ID || !within) continue;
    const auto& at = sensed.sensorLocationOnRobot;
    const Eigen::Vector3d antenna(at.x(), at.y(), at.z());
    if (!antenna.allFinite() || !std::isfinite(range)) continue;
    readings.push_back({observation.stamp, sensed.beaconID, antenna, range,
                        std::max(kLeastSigmaM, static_cast<double>(ranges->stdError))});
  }
  return readings;
}

}  // namespace lamp
