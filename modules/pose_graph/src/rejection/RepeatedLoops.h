#pragma once

#include <utility>
#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Admitted loop closures that repeat an earlier admitted edge word for word, each with that edge,
 * in order. Such a loop is the same measurement written twice, not a second witness. Pinned loops
 * are left alone. */
std::vector<std::pair<EdgeIndex, EdgeIndex>> repeatedLoops(const PoseGraph& graph,
                                                           const std::vector<bool>& admitted);

}  // namespace lamp
