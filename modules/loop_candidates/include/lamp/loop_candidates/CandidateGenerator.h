#pragma once

#include <vector>

#include "lamp/core/KeyNodePacket.h"
#include "lamp/core/LoopClosure.h"
#include "lamp/core/PoseGraph.h"
#include "lamp/core/Stage.h"

namespace lamp {

/** Finds pairs of key nodes that may see the same place (paper II-C, "Loop closure generation"). */
class CandidateGenerator : public Stage {
  DEFINE_VIRTUAL_MRPT_OBJECT(CandidateGenerator)

 public:
  /** A key node that has just arrived; each once, those of a robot in order. For generators that
   * keep an index of their own. */
  virtual void add(const KeyNodePacket&) {}
  /** No more key nodes of a robot follow. */
  virtual void end(RobotId) {}
  /** Candidates between key nodes of `current`'s robot and others, of its own or other robots. Most
   * generators propose those of `current`, by the graph's current estimate and nearest first within
   * each robot; one that has to see what follows a key node proposes that one's candidates later.
   * Called for a key node when it has arrived, for a robot's last one when it has ended, and again
   * when an optimisation has moved it. */
  virtual std::vector<LoopClosureCandidate> propose(const PoseGraph& graph, KeyNodeId current) = 0;
};

/** Registers the generators of this module. */
void registerAllClasses_lamp_loop_candidates();

}  // namespace lamp
