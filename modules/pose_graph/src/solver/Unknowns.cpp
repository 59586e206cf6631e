#include "solver/Unknowns.h"

#include "solver/GaugeAnchors.h"

namespace lamp {

namespace {

/** Which components, by their gauge, have a gravity edge. */
std::vector<bool> levelGauges(const PoseGraph& graph, const std::vector<double>& weights,
                              const std::vector<std::optional<size_t>>& gauge) {
  std::vector<bool> level(graph.nodes().size(), false);
  if (graph.planar()) return level;
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (edge.type != EdgeType::kGravity || !(weights[e] > 0)) continue;
    if (const auto anchor = gauge[graph.place(edge.from)]) level[*anchor] = true;
  }
  return level;
}

}  // namespace

Unknowns findUnknowns(const PoseGraph& graph, const std::vector<double>& weights) {
  const auto gauge = gauges(graph, weights);
  const std::vector<bool> level = levelGauges(graph, weights, gauge);
  Unknowns unknowns;
  unknowns.row.assign(graph.nodes().size() + graph.landmarks().size(), -1);
  for (size_t i = 0; i < graph.nodes().size(); ++i) {
    if (graph.nodes()[i].fixed || (gauge[i] == i && !level[i])) continue;
    if (gauge[i] == i) unknowns.level_anchors.push_back(i);
    unknowns.row[i] = unknowns.size++;
  }
  unknowns.first_landmark_row = unknowns.size;
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (!edge.endsAtLandmark() || !(weights[e] > 0) || graph.landmarks()[edge.landmark].known)
      continue;
    int& row = unknowns.row[graph.nodes().size() + edge.landmark];
    if (row < 0) row = unknowns.size++;
  }
  return unknowns;
}

}  // namespace lamp
