#pragma once

#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Poses `world_T_base` that trust odometry only, in the order of PoseGraph::nodes().
 *
 * Each chain of odometry edges is laid out rigidly from its prior. Chains that have none, or one
 * that is less sure than the loop closures that agree, are placed by the robust average of their
 * admitted loops to chains that are placed (the most agreeing first); where there are none either,
 * by the current estimate of their first key node. Between fixed key nodes a chain is bent.
 * \param admitted one flag for each edge. */
std::vector<Pose3> initialGuess(const PoseGraph& graph, const std::vector<bool>& admitted);
/** All loops are admitted. */
std::vector<Pose3> initialGuess(const PoseGraph& graph);

/** Along a spanning tree of few edges over odometry and all loop closures that are not
 * rejected: one frame for each component. */
std::vector<Pose3> spanningTreeGuess(const PoseGraph& graph);

/** Chordal initialisation (Martinec, Pajdla, CVPR 2007; Carlone, Tron, Daniilidis, Dellaert, ICRA
 * 2015, section III-B): rotations from a linear problem without their constraints, brought back to
 * SO(3), then positions from another linear problem. Over odometry and all loop closures that are
 * not rejected; outliers among them spoil it. Held where spanningTreeGuess() starts. */
std::vector<Pose3> chordalGuess(const PoseGraph& graph);

}  // namespace lamp
