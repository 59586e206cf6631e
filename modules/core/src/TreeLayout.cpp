#include "lamp/core/TreeLayout.h"

namespace lamp {

TreeLayout::TreeLayout(const PoseGraph& graph)
    : steps_(graph.nodes().size()),
      placed_(graph.nodes().size(), false),
      poses_(graph.nodes().size(), Pose3::Identity()) {
  for (const Edge& edge : graph.edges()) {
    if (!edge.joinsPoses() || !edge.active()) continue;
    const size_t from = graph.place(edge.from), to = graph.place(edge.to);
    steps_[from].push_back({to, edge.from_T_to});
    steps_[to].push_back({from, edge.from_T_to.inverse()});
  }
}

void TreeLayout::place(size_t node, const Pose3& world_T_base) {
  placed_[node] = true;
  poses_[node] = normalized(world_T_base);
  reached_.push_back(node);
}

void TreeLayout::spread() {
  for (size_t next = 0; next < reached_.size(); ++next) {
    const size_t at = reached_[next];
    for (const Step& step : steps_[at])
      if (!placed_[step.to]) place(step.to, poses_[at] * step.at_T_to);
  }
  reached_.clear();
}

}  // namespace lamp
