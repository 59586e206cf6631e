#pragma once

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Adds false loop closures: random pairs of key nodes, random relative poses within the extent of
 * the current estimates, and the information of loops drawn from those there are.
 * \param share of all loops afterwards, in [0, 1). */
void addFalseLoops(PoseGraph& graph, double share, unsigned seed);

}  // namespace lamp
