#pragma once

#include <vector>

#include "lamp/core/PoseGraph.h"
#include "lamp/refinement/JointAdjustment.h"
#include "lamp/refinement/SharedSurfels.h"

namespace lamp {

/** Two key nodes, by their places in the graph. */
struct SurfelPair {
  size_t a = 0, b = 0;
};

/** Pairs of key nodes of one component that have seen enough of the same surfels: neighbours in
 * sequence first, then others as chance has it, so that they are spread over all that overlap,
 * until each key node has as many as the options say. Pairs whose surfels the graph knows too badly
 * to tell them from the next ones are left out. */
std::vector<SurfelPair> chooseSurfelPairs(const PoseGraph& graph, const SharedSurfels& shared,
                                          const RefinementOptions& options);

}  // namespace lamp
