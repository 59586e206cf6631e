#pragma once

#include <mrpt/obs/CObservation.h>

#include <optional>

#include "lamp/core/Geometry.h"

namespace lamp {

/** Dead reckoning at one instant. */
struct OdometryReading {
  double stamp = 0;                       ///< seconds, UTC
  Pose3 odom_T_base = Pose3::Identity();  ///< since some start of the recording robot's choice
  /** Of the absolute pose, in the tangent space at it; none if the recording has no usable one. */
  std::optional<Matrix6d> covariance;
  bool planar = false;  ///< x, y, and yaw only
};

/** CObservationOdometry or CObservationRobotPose. */
bool isOdometry(const mrpt::obs::CObservation& observation);

/** \return none if the class is no odometry, or the pose is not finite.
 *
 * CObservationRobotPose holds the pose of a tracking sensor that is mounted at `sensorPose` on the
 * robot: `odom_T_base = pose · sensorPose⁻¹`. */
std::optional<OdometryReading> odometryFromObservation(const mrpt::obs::CObservation& observation);

}  // namespace lamp
