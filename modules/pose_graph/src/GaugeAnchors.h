#pragma once

#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Nodes (places in PoseGraph::nodes()) that must be held so that the least-squares problem has one
 * solution: the first key node of each component that no prior reaches. Components are joined by
 * edges with a weight above zero; priors do not join.
 * \param weights one for each edge. */
std::vector<size_t> gaugeAnchors(const PoseGraph& graph, const std::vector<double>& weights);

}  // namespace lamp
