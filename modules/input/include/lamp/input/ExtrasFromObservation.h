#pragma once

#include <optional>
#include <vector>

#include "lamp/core/KeyNodePacket.h"
#include "lamp/input/ObservationSource.h"

namespace lamp {

/** One reading of an inertial unit, in the base frame's axes. */
struct InertialReading {
  Eigen::Vector3d specific_force;    ///< m/s²: at rest, 9.8 upwards
  Eigen::Vector3d angular_velocity;  ///< rad/s
};

/** Of a CObservationIMU with accelerometers and gyros; none of others, or if not finite. */
std::optional<InertialReading> inertialFromObservation(const InputObservation& observation);

/** Of a CObservationBearingRange, those with a number: landmark `label_NUMBER`. In the base frame
 * at the stamp. Standard deviations are those of the sensor, or of each measurement
 * where it has its own; never below 0.01 m and 0.1°. */
std::vector<LandmarkSighting> sightingsFromObservation(const InputObservation& observation);

/** Of a CObservationBeaconRanges, those with a number and within the sensor's limits. */
std::vector<RangeReading> rangesFromObservation(const InputObservation& observation);

}  // namespace lamp
