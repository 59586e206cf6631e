#pragma once

#include "lamp/loop_candidates/CandidateGenerator.h"

namespace lamp {

struct PlanarNeighborsOptions {
  int max_index_gap = 4;

  void visit(OptionVisitor& v);
};

/** The key nodes shortly before the current one, for robots in the plane: matching each scan with
 * those before it takes the place of wheel odometry, whose heading is weak. Proposes nothing for
 * robots in space, whose odometry is mostly made of scans already. */
class PlanarNeighbors : public CandidateGenerator {
  DEFINE_MRPT_OBJECT(PlanarNeighbors, lamp)

 public:
  PlanarNeighborsOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  std::vector<LoopClosureCandidate> propose(const PoseGraph& graph,
                                            KeyNodeId current) const override;
};

}  // namespace lamp
