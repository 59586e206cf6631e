#pragma once

#include <vector>

#include "lamp/core/LoopClosure.h"
#include "lamp/core/PoseGraph.h"
#include "lamp/core/Stage.h"

namespace lamp {

/** Finds pairs of key nodes that may see the same place (paper II-C, "Loop closure generation"). */
class CandidateGenerator : public Stage {
  DEFINE_VIRTUAL_MRPT_OBJECT(CandidateGenerator)

 public:
  /** Candidates between `current` and the other key nodes, of its own robot and of others, by the
   * graph's current estimate; nearest first within each robot. */
  virtual std::vector<LoopClosureCandidate> propose(const PoseGraph& graph,
                                                    KeyNodeId current) const = 0;
};

/** Registers the generators of this module. */
void registerAllClasses_lamp_loop_candidates();

}  // namespace lamp
