#pragma once

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Adds false loop closures: random pairs of key nodes with random relative poses within the extent
 * of the current estimates, and with the information of existing loops drawn at random.
 * \param share of false loops among all loops afterwards, in [0, 1). */
void addFalseLoops(PoseGraph& graph, double share, unsigned seed);

}  // namespace lamp
