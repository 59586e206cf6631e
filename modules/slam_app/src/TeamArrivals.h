#pragma once

#include <map>
#include <vector>

#include "lamp/input/InputReport.h"
#include "lamp/slam_app/SlamConfig.h"
#include "lamp/transport/ArrivalTimes.h"

namespace lamp {

/** The arrivals files of the ini's robots. \throws what readArrivals() does. */
std::map<RobotId, ArrivalTimes> readTeamArrivals(const SlamConfig& config);

/** \param robots found in the recordings so far.
 *  \throws std::runtime_error naming the robots with a lidar of which the ini says nothing, if key
 *  nodes are to come in the order of arrival. */
void requireArrivals(const SlamConfig& config, const std::vector<RobotReport>& robots);

}  // namespace lamp
