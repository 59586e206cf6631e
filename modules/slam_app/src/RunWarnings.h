#pragma once

#include <string>
#include <vector>

#include "lamp/base_station/BaseStation.h"

namespace lamp {

/** Whether two robots that move in the plane share no frame: scans of 2D lasers are matched from a
 * guess only, and such robots have none. */
bool planarRobotsAreUnrelated(const PoseGraph& graph);

/** What a user should know about a run as a whole. */
std::vector<std::string> runWarnings(const BaseStation& base);

}  // namespace lamp
