#pragma once

#include <utility>
#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Admitted loop closures that repeat an earlier admitted edge word for word, and that edge: one
 * measurement that was written twice, and no second witness. Pinned ones are left alone. In their
 * order. */
std::vector<std::pair<EdgeIndex, EdgeIndex>> repeatedLoops(const PoseGraph& graph,
                                                           const std::vector<bool>& admitted);

}  // namespace lamp
