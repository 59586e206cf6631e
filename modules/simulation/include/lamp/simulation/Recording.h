#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lamp/core/KeyedScan.h"
#include "lamp/simulation/KeyedScans.h"

namespace lamp::simulation {

/** Told the share of the work that is done, 0 to 1. */
using ShareDone = std::function<void(double)>;

/** Writes key nodes only, like NeBula's data: odometry, the keyed scan and an IMU reading at each
 * key node's stamp, RSSI and artifacts between. \param scans one a key node. */
void writeKeyedRecording(const std::string& path, const MissionRobot& robot,
                         const std::vector<KeyedScanPtr>& scans, const Mission& mission,
                         const SimConfig& config);

/** Writes all that the robot's sensors gave, at full rate: `CObservationVelodyneScan` as packets,
 * odometry, IMU, RSSI, artifacts. Sweeps are computed on the caller's TBB arena. Marks what was
 * seen. \param[out] moving for each scan the returns from movers, in the base frame at its stamp.
 */
void writeRawRecording(const std::string& path, const MissionRobot& robot, const Mission& mission,
                       const SimConfig& config, SeenTriangles& seen, MovingPoints& moving,
                       const ShareDone& done);

}  // namespace lamp::simulation
