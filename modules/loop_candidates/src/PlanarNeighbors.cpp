#include "lamp/loop_candidates/PlanarNeighbors.h"

IMPLEMENTS_MRPT_OBJECT(PlanarNeighbors, lamp::CandidateGenerator, lamp)

namespace lamp {

void PlanarNeighborsOptions::visit(OptionVisitor& v) {
  v("max_index_gap", max_index_gap, "key nodes",
    "a key node of a robot in the plane is matched with so many before it", {1});
}

std::vector<LoopClosureCandidate> PlanarNeighbors::propose(const PoseGraph& graph,
                                                           KeyNodeId current) const {
  std::vector<LoopClosureCandidate> candidates;
  const Node& node = graph.node(current);
  if (!node.planar || !isFinite(node.world_T_base)) return candidates;
  for (uint32_t gap = 1; gap <= static_cast<uint32_t>(options.max_index_gap); ++gap) {
    if (gap > current.index) break;
    const KeyNodeId before{current.robot, current.index - gap};
    if (!graph.contains(before) || !graph.node(before).planar ||
        !isFinite(graph.node(before).world_T_base))
      continue;
    candidates.push_back({before, current, getLoggerName(), 0});
  }
  return candidates;
}

}  // namespace lamp
