#include "lamp/loop_candidates/Neighbors.h"

IMPLEMENTS_MRPT_OBJECT(Neighbors, lamp::CandidateGenerator, lamp)

namespace lamp {

void NeighborsOptions::visit(OptionVisitor& v) {
  v("max_index_gap", max_index_gap, "key nodes",
    "number of key nodes before it that each key node is registered with; 0 leaves the motion "
    "between them to odometry",
    kNotNegative);
}

std::vector<LoopClosureCandidate> Neighbors::propose(const PoseGraph& graph, KeyNodeId current) {
  std::vector<LoopClosureCandidate> candidates;
  const Node& node = graph.node(current);
  if (!isFinite(node.world_T_base)) return candidates;
  const auto reach = static_cast<uint32_t>(options.max_index_gap);
  for (uint32_t gap = 1; gap <= reach && gap <= current.index; ++gap) {
    const KeyNodeId before{current.robot, current.index - gap};
    if (!graph.contains(before) || graph.node(before).planar != node.planar ||
        !isFinite(graph.node(before).world_T_base))
      continue;
    LoopClosureCandidate candidate{before, current, getLoggerName()};
    candidate.why = "in sequence";
    candidate.certain_guess = true;
    candidates.push_back(candidate);
  }
  return candidates;
}

}  // namespace lamp
