#pragma once

#include <mrpt/obs/CObservationPointCloud.h>

#include <string>

#include "lamp/core/KeyedScan.h"

namespace lamp {

/** What one sensor saw of a keyed scan, as rawlogs hold it: label `robot/sensor`, points in a frame
 * at the sensor's origin with the axes of the base, intensity where the scan has it.
 * \param sensor place in Scan::sensors; \param stamp seconds, UTC. */
mrpt::obs::CObservationPointCloud scanObservation(const Scan& scan, size_t sensor,
                                                  const std::string& robot, double stamp);

}  // namespace lamp
