#pragma once

#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Poses `world_T_base` by odometry, in the order of PoseGraph::nodes().
 *
 * Each chain of odometry edges is laid out rigidly from its prior. A chain without a prior, or with
 * one less certain than the loop closures that agree, is placed by the robust average of its
 * admitted loops to a chain placed already (the chain with most agreeing loops first); without such
 * loops, by the current estimate of its first key node. Between fixed key nodes a chain is bent to
 * meet them.
 * \param admitted one flag per edge. */
std::vector<Pose3> initialGuess(const PoseGraph& graph, const std::vector<bool>& admitted);
/** Admits all loop closures. */
std::vector<Pose3> initialGuess(const PoseGraph& graph);

/** Poses along breadth-first spanning trees of odometry and all loop closures that are not
 * rejected, one tree for each component. */
std::vector<Pose3> spanningTreeGuess(const PoseGraph& graph);

/** Chordal initialisation (Martinec, Pajdla, CVPR 2007; Carlone, Tron, Daniilidis, Dellaert, ICRA
 * 2015, section III-B): rotations from a linear problem that ignores their constraints, projected
 * back onto SO(3), then positions from a second linear problem. Uses odometry and all loop closures
 * that are not rejected; outliers among them spoil the result. Anchored where spanningTreeGuess()
 * starts. */
std::vector<Pose3> chordalGuess(const PoseGraph& graph);

}  // namespace lamp
