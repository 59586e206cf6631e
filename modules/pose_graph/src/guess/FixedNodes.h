#pragma once

#include <vector>

#include "rejection/OdometryChains.h"

namespace lamp {

/** Lets each chain of odometry pass through its fixed key nodes: what is missing there, in position
 * and in rotation, is spread evenly over the key nodes between two of them; before the first and
 * behind the last one the chain stays rigid.
 * \param poses world_T_base in the order of PoseGraph::nodes(). */
void bendToFixedNodes(const PoseGraph& graph, const OdometryChains& chains,
                      std::vector<Pose3>& poses);

}  // namespace lamp
