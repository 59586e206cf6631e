#include "solver/GaugeAnchors.h"

#include "lamp/core/DisjointSets.h"

namespace lamp {

std::vector<std::optional<size_t>> gauges(const PoseGraph& graph,
                                          const std::vector<double>& weights) {
  const std::vector<Node>& nodes = graph.nodes();
  const std::vector<Edge>& edges = graph.edges();
  DisjointSets components(nodes.size());
  for (size_t e = 0; e < edges.size(); ++e)
    if (edges[e].joinsPoses() && weights[e] > 0)
      components.join(graph.place(edges[e].from), graph.place(edges[e].to));

  std::vector<bool> held(nodes.size(), false);
  for (size_t e = 0; e < edges.size(); ++e)
    if (edges[e].type == EdgeType::kPrior && weights[e] > 0)
      held[components.root(graph.place(edges[e].from))] = true;
  for (size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].fixed) held[components.root(i)] = true;

  std::vector<size_t> first(nodes.size());  // by root
  for (size_t i = 0; i < nodes.size(); ++i) {
    const size_t root = components.root(i);
    if (root == i || nodes[i].id < nodes[first[root]].id) first[root] = i;
  }
  std::vector<std::optional<size_t>> result(nodes.size());
  for (size_t i = 0; i < nodes.size(); ++i)
    if (const size_t root = components.root(i); !held[root]) result[i] = first[root];
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
