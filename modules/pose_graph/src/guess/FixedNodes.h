#pragma once

#include <vector>

#include "rejection/OdometryChains.h"

namespace lamp {

/** Bends each chain of odometry so that it passes through its fixed key nodes: the misfit there, in
 * position and rotation, is spread evenly over the key nodes between two of them. Before the first
 * and after the last one the chain stays rigid.
 * \param poses world_T_base in the order of PoseGraph::nodes(). */
void bendToFixedNodes(const PoseGraph& graph, const OdometryChains& chains,
                      std::vector<Pose3>& poses);

}  // namespace lamp
