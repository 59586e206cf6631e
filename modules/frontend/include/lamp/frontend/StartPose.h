#pragma once

#include <optional>

#include "lamp/core/KeyNodePacket.h"
#include "lamp/input/RobotOptions.h"

namespace lamp {

/** The prior on a robot's first key node, none if the ini gives no start pose.
 *
 * Without sigmas in the ini the first robot with a start pose gets LAMP's tight prior, which ties
 * the team to the world, and the others 0.5 m and 5°.
 */
std::optional<StartPrior> startPrior(const RobotOptions& robot, bool first);

}  // namespace lamp
