#pragma once

#include "lamp/loop_candidates/CandidateGenerator.h"

namespace lamp {

struct NeighborsOptions {
  int max_index_gap = 2;

  void visit(OptionVisitor& v);
};

/** The key nodes shortly before the current one: registering consecutive keyed scans says more of
 * the motion between them than odometry does, and of the heading of a robot in the plane far more.
 * What they say is an edge like a loop closure's, which the back end may reject. Odometry is a good
 * guess there, so nothing beyond it is searched. */
class Neighbors : public CandidateGenerator {
  DEFINE_MRPT_OBJECT(Neighbors, lamp)

 public:
  NeighborsOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  std::vector<LoopClosureCandidate> propose(const PoseGraph& graph, KeyNodeId current) override;
};

}  // namespace lamp
