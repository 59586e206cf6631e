#include "rejection/RepeatedLoops.h"

#include <algorithm>
#include <map>

namespace lamp {

std::vector<std::pair<EdgeIndex, EdgeIndex>> repeatedLoops(const PoseGraph& graph,
                                                           const std::vector<bool>& admitted) {
  std::vector<std::pair<EdgeIndex, EdgeIndex>> repeated;
  std::map<std::pair<KeyNodeId, KeyNodeId>, std::vector<EdgeIndex>> by_ends;
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (!edge.joinsPoses() || !admitted[e]) continue;
    std::vector<EdgeIndex>& others = by_ends[{edge.from, edge.to}];
    const auto same = std::find_if(others.begin(), others.end(), [&](EdgeIndex other) {
      return graph.edges()[other].from_T_to.matrix() == edge.from_T_to.matrix() &&
             graph.edges()[other].information == edge.information;
    });
    if (same == others.end())
      others.push_back(e);
    else if (edge.isLoopClosure() && !edge.pinned)
      repeated.emplace_back(e, *same);
  }
  return repeated;
}

}  // namespace lamp
