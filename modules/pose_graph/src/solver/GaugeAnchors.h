#pragma once

#include <optional>
#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** For each node the one (both as places in PoseGraph::nodes()) that its pose is known relative to:
 * the first key node of its component; none for the world, if a prior or a fixed key node reaches
 * the component.
 * Components are joined by edges with a weight above zero; priors do not join.
 * \param weights one for each edge. */
std::vector<std::optional<size_t>> gauges(const PoseGraph& graph,
                                          const std::vector<double>& weights);

/** Nodes that must be held so that the least-squares problem has one solution: those that are
 * gauges(), in order. */
std::vector<size_t> gaugeAnchors(const PoseGraph& graph, const std::vector<double>& weights);

}  // namespace lamp
