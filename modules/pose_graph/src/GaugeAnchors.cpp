#include "GaugeAnchors.h"

#include <numeric>
#include <utility>

namespace lamp {

namespace {

/** Disjoint sets, each of which knows its first key node and whether a prior holds it. */
class Components {
 public:
  explicit Components(const std::vector<Node>& nodes) : nodes_(nodes), parent_(nodes.size()) {
    std::iota(parent_.begin(), parent_.end(), size_t{0});
  }

  /** The root is always the first key node of its set. */
  size_t root(size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join(size_t a, size_t b) {
    a = root(a);
    b = root(b);
    if (nodes_[b].id < nodes_[a].id) std::swap(a, b);
    parent_[b] = a;
  }

 private:
  const std::vector<Node>& nodes_;
  std::vector<size_t> parent_;
};

}  // namespace

std::vector<std::optional<size_t>> gauges(const PoseGraph& graph,
                                          const std::vector<double>& weights) {
  Components components(graph.nodes());
  const std::vector<Edge>& edges = graph.edges();
  for (size_t e = 0; e < edges.size(); ++e)
    if (edges[e].type != EdgeType::kPrior && weights[e] > 0)
      components.join(graph.place(edges[e].from), graph.place(edges[e].to));

  std::vector<bool> held(graph.nodes().size(), false);
  for (size_t e = 0; e < edges.size(); ++e)
    if (edges[e].type == EdgeType::kPrior && weights[e] > 0)
      held[components.root(graph.place(edges[e].from))] = true;

  std::vector<std::optional<size_t>> result(graph.nodes().size());
  for (size_t i = 0; i < result.size(); ++i)
    if (const size_t root = components.root(i); !held[root]) result[i] = root;
  return result;
}

std::vector<size_t> gaugeAnchors(const PoseGraph& graph, const std::vector<double>& weights) {
  const std::vector<std::optional<size_t>> gauge = gauges(graph, weights);
  std::vector<size_t> anchors;
  for (size_t i = 0; i < gauge.size(); ++i)
    if (gauge[i] == i) anchors.push_back(i);
  return anchors;
}

}  // namespace lamp
