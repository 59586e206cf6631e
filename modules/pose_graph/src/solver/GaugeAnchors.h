#pragma once

#include <optional>
#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** For each node, the node relative to which its pose is known (both as places in
 * PoseGraph::nodes()): the first key node of its component, or none, meaning the world, if a prior
 * or a fixed key node reaches the component. Edges with a weight above zero join components; priors
 * do not.
 * \param weights one per edge. */
std::vector<std::optional<size_t>> gauges(const PoseGraph& graph,
                                          const std::vector<double>& weights);

/** Nodes that must be held for the least-squares problem to have one solution: those that gauges()
 * names, ascending. */
std::vector<size_t> gaugeAnchors(const PoseGraph& graph, const std::vector<double>& weights);

}  // namespace lamp
