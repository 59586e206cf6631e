#include "lamp/base_station/LoopCounts.h"

#include <algorithm>

namespace lamp {

LoopCounts countLoops(const BaseStation& base) {
  LoopCounts counts;
  counts.candidates = base.candidates();
  counts.attempts = base.ledger().rows().size();
  for (const Edge& edge : base.graph().edges()) {
    if (edge.type != EdgeType::kLoopClosure) continue;
    ++counts.verified;
    if (edge.verdict == Verdict::kInlier) ++counts.inliers;
  }
  return counts;
}

KeptLoops keptLoops(const PoseGraph& graph, const std::vector<FrameAgreement>& frames) {
  const auto isApart = [&](const Edge& edge) {
    return std::any_of(frames.begin(), frames.end(), [&](const FrameAgreement& agreement) {
      return !agreement.joined &&
             std::minmax(agreement.a, agreement.b) == std::minmax(edge.from.robot, edge.to.robot);
    });
  };
  KeptLoops counts;
  for (const Edge& edge : graph.edges()) {
    if (edge.type != EdgeType::kLoopClosure || edge.verdict == Verdict::kPending || isApart(edge))
      continue;
    ++counts.loops;
    counts.kept += edge.verdict == Verdict::kInlier;
  }
  return counts;
}

ComponentLoops countLoops(const PoseGraph& graph, const Component& component) {
  ComponentLoops loops;
  for (const Edge& edge : graph.edges()) {
    if (edge.type != EdgeType::kLoopClosure || edge.verdict != Verdict::kInlier) continue;
    if (!std::binary_search(component.nodes.begin(), component.nodes.end(), edge.from)) continue;
    ++(edge.betweenRobots() ? loops.between_robots : loops.within_robots);
  }
  return loops;
}

MeasurementCounts countMeasurements(const PoseGraph& graph) {
  MeasurementCounts counts;
  for (const Edge& edge : graph.edges()) {
    if (edge.joinsPoses() || edge.type == EdgeType::kPrior) continue;
    ++counts.edges;
    counts.inliers += edge.verdict == Verdict::kInlier;
  }
  return counts;
}

}  // namespace lamp
