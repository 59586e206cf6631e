#pragma once

#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Poses `world_T_base` that trust odometry only, in the order of PoseGraph::nodes().
 *
 * Each chain of odometry edges is laid out rigidly from its first key node with a prior, or, where
 * it has none, from the current estimate of its first key node. Loop closures are not used. */
std::vector<Pose3> initialGuess(const PoseGraph& graph);

}  // namespace lamp
