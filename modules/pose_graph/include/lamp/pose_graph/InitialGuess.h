#pragma once

#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Poses `world_T_base` that trust odometry only, in the order of PoseGraph::nodes().
 *
 * Each chain of odometry edges is laid out rigidly from its first key node with a prior, or, where
 * it has none, from the current estimate of its first key node. Loop closures are not used. */
std::vector<Pose3> initialGuess(const PoseGraph& graph);

/** The same along a spanning tree of few edges over odometry and all loop closures that are not
 * rejected: one frame for each component. */
std::vector<Pose3> spanningTreeGuess(const PoseGraph& graph);

/** Chordal initialisation (Martinec, Pajdla, CVPR 2007; Carlone, Tron, Daniilidis, Dellaert, ICRA
 * 2015, section III-B): rotations from a linear problem without their constraints, brought back to
 * SO(3), then positions from another linear problem. Over odometry and all loop closures that are
 * not rejected; outliers among them spoil it. Held where spanningTreeGuess() starts. */
std::vector<Pose3> chordalGuess(const PoseGraph& graph);

}  // namespace lamp
