#pragma once

#include "lamp/loop_candidates/CandidateGenerator.h"

namespace lamp {

struct GlobalSearchOptions {
  int max_per_robot = 10;
  int max_other_robots = 4;

  void visit(OptionVisitor& v);
};

/** For robots whose poses cannot be compared (PoseGraph::shareFrame): nothing tells which key nodes
 * are near, so a few of the other robot's are tried, spread evenly over its way, others with each
 * new key node; with many such robots a few of them, others with each new key node. Proposes
 * nothing once the robots share a frame. */
class GlobalSearch : public CandidateGenerator {
  DEFINE_MRPT_OBJECT(GlobalSearch, lamp)

 public:
  GlobalSearchOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  std::vector<LoopClosureCandidate> propose(const PoseGraph& graph,
                                            KeyNodeId current) const override;
};

}  // namespace lamp
