#pragma once

#include <lamp/loop_candidates/CandidateGenerator.h>

namespace lamp {

struct SameHeadingOptions {
  double radius_m = 10.0;
  double max_angle_deg = 45.0;
  int min_index_gap = 10;
  int max_per_robot = 3;

  void visit(OptionVisitor& v);
};

/** Near key nodes that look the same way: two scans of a sensor that does not see all around have
 * little in common otherwise. */
class SameHeading : public CandidateGenerator {
  DEFINE_MRPT_OBJECT(SameHeading, lamp)

 public:
  void visit(OptionVisitor& v) override { options_.visit(v); }
  std::vector<LoopClosureCandidate> propose(const PoseGraph& graph,
                                            KeyNodeId current) override;

 private:
  bool maybeLoop(const Node& current, const Node& other) const;

  SameHeadingOptions options_;
};

}  // namespace lamp
