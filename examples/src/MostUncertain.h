#pragma once

#include <lamp/loop_priority/Prioritizer.h>

namespace lamp {

/** Computes first the loop closures whose relative position the graph knows least: they correct the
 * map most. Those between parts that nothing relates yet come before all others. */
class MostUncertain : public Prioritizer {
  DEFINE_MRPT_OBJECT(MostUncertain, lamp)

 public:
  void visit(OptionVisitor&) override {}
  void order(std::vector<LoopClosureCandidate>& candidates, const PoseGraph& graph,
             const UncertaintyQuery& uncertainty) override;
};

}  // namespace lamp
