#include "lamp/pose_graph/InitialGuess.h"

#include <algorithm>
#include <utility>

namespace lamp {

namespace {

/** Lays out everything that the wanted edges join to the nodes that are placed one by one. */
class ChainLayout {
 public:
  template <class Wanted>
  ChainLayout(const PoseGraph& graph, Wanted wanted)
      : steps_(graph.nodes().size()),
        placed_(graph.nodes().size(), false),
        poses_(graph.nodes().size(), Pose3::Identity()) {
    for (const Edge& edge : graph.edges()) {
      if (edge.type == EdgeType::kPrior || !wanted(edge)) continue;
      const size_t from = graph.place(edge.from), to = graph.place(edge.to);
      steps_[from].push_back({to, edge.from_T_to});
      steps_[to].push_back({from, edge.from_T_to.inverse()});
    }
  }

  void place(size_t seed, const Pose3& world_T_base) {
    if (placed_[seed]) return;
    set(seed, world_T_base);
    std::vector<size_t> reached = {seed};
    for (size_t next = 0; next < reached.size(); ++next) {
      const size_t at = reached[next];
      for (const Step& step : steps_[at]) {
        if (placed_[step.to]) continue;
        set(step.to, poses_[at] * step.at_T_to);
        reached.push_back(step.to);
      }
    }
  }

  std::vector<Pose3> take() { return std::move(poses_); }

 private:
  struct Step {
    size_t to;
    Pose3 at_T_to;
  };

  void set(size_t node, const Pose3& world_T_base) {
    placed_[node] = true;
    poses_[node] = normalized(world_T_base);
  }

  std::vector<std::vector<Step>> steps_;
  std::vector<bool> placed_;
  std::vector<Pose3> poses_;
};

template <class Wanted>
std::vector<Pose3> layOut(const PoseGraph& graph, Wanted wanted) {
  std::vector<const Edge*> priors;
  for (const Edge& edge : graph.edges())
    if (edge.type == EdgeType::kPrior) priors.push_back(&edge);
  std::stable_sort(priors.begin(), priors.end(),
                   [](const Edge* a, const Edge* b) { return a->from < b->from; });

  ChainLayout layout(graph, wanted);
  for (const Edge* prior : priors) layout.place(graph.place(prior->from), prior->from_T_to);
  for (const RobotId robot : graph.robots())
    for (const KeyframeId id : graph.robotNodes(robot))
      layout.place(graph.place(id), graph.node(id).world_T_base);
  return layout.take();
}

}  // namespace

std::vector<Pose3> initialGuess(const PoseGraph& graph) {
  return layOut(graph, [](const Edge& edge) { return edge.type == EdgeType::kOdometry; });
}

std::vector<Pose3> spanningTreeGuess(const PoseGraph& graph) {
  return layOut(graph, [](const Edge& edge) { return edge.active(); });
}

}  // namespace lamp
