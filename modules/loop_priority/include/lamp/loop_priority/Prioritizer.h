#pragma once

#include <vector>

#include "lamp/core/LoopClosure.h"
#include "lamp/core/PoseGraph.h"
#include "lamp/core/Stage.h"
#include "lamp/core/UncertaintyQuery.h"

namespace lamp {

/** Order in which loop closure candidates are computed (paper II-C, "Loop closure prioritization").
 */
class Prioritizer : public Stage {
  DEFINE_VIRTUAL_MRPT_OBJECT(Prioritizer)

 public:
  /** Sets the priority of each candidate and sorts them, most promising first; ties keep their
   * order. */
  virtual void order(std::vector<LoopClosureCandidate>& candidates, const PoseGraph& graph,
                     const UncertaintyQuery& uncertainty) = 0;
};

/** First come, first computed, as in LAMP 1.0. */
class Arrival : public Prioritizer {
  DEFINE_MRPT_OBJECT(Arrival, lamp)

 public:
  void visit(OptionVisitor&) override {}
  void order(std::vector<LoopClosureCandidate>& candidates, const PoseGraph& graph,
             const UncertaintyQuery& uncertainty) override;
};

void registerAllClasses_lamp_loop_priority();

}  // namespace lamp
