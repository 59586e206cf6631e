#pragma once

#include "lamp/pose_graph/Optimizer.h"
#include "lamp/pose_graph/OutlierRejection.h"

namespace lamp {

/** Waiting loop closures that a solution without them bears out.
 *
 * A loop is taken if it agrees with the solution's relative pose of its key nodes, within the
 * covariances of both, and chance does not explain that: a false loop's relative pose is uniform
 * over the map, and would seldom lie so near. A loop that agrees within its own covariance is
 * judged by that alone.
 * \param graph that was optimised. \param result of that. */
std::vector<EdgeIndex> borneOut(const PoseGraph& graph, const OptimizationResult& result,
                                const Admission& admission);

}  // namespace lamp
