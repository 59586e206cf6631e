#include "lamp/pose_graph/Optimizer.h"

#include "lamp/pose_graph/EdgeResiduals.h"

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(Optimizer, Stage, lamp)

namespace lamp {

void applyResult(const OptimizationResult& result, PoseGraph& graph) {
  if (!result.report.usable) return;
  for (size_t i = 0; i < result.world_T_base.size(); ++i)
    graph.node(graph.nodes()[i].id).world_T_base = result.world_T_base[i];
  for (LandmarkIndex i = 0; i < result.landmarks.size(); ++i) {
    Landmark& landmark = graph.landmarks()[i];
    landmark.placed = landmark.known || result.landmarks[i].has_value();
    if (result.landmarks[i]) landmark.world_p = *result.landmarks[i];
  }
  for (const LoopVerdict& loop : result.loops) {
    Edge& edge = graph.edges()[loop.edge];
    edge.verdict = loop.verdict;
    edge.weight = loop.weight;
    edge.chi2 = loop.chi2;
  }
  const std::vector<double> residuals2 = edgeResiduals2(graph, result.world_T_base);
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e)
    if (graph.edges()[e].pinned) graph.edges()[e].chi2 = residuals2[e];
}

}  // namespace lamp
