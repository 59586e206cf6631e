#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lamp/simulation/Lidar.h"

namespace mrpt::obs {
class CObservationVelodyneScan;
}

namespace lamp::simulation {

/** A sweep as packets of a VLP-16: one observation, or for a rotating mount several short ones,
 * each with the sensor's pose at the middle of its time.
 *
 * What MRPT 2.5.8 makes of packets, found by trial: of a block's two firing sequences it reads only
 * the first; the azimuth of a laser is the block's plus `id/48` of the packet's median step,
 * rounded to 0.01 deg (its table of sines is off by up to 0.01 deg more); every point gets the
 * time of its packet, 1.3 ms long for a VLP-16.
 *
 * \param label `robot/name` */
std::vector<std::shared_ptr<mrpt::obs::CObservationVelodyneScan>> velodyneObservations(
    const LidarSweep& sweep, const Lidar& lidar, const std::string& label);

}  // namespace lamp::simulation
