#pragma once

#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Squared Mahalanobis residual of each edge, without its weight, at poses in the order of
 * PoseGraph::nodes(). */
std::vector<double> edgeResiduals2(const PoseGraph& graph, const std::vector<Pose3>& world_T_base);

}  // namespace lamp
