#include "lamp/pose_graph/BackEnd.h"

#include <algorithm>
#include <utility>

#include "rejection/Readmission.h"
#include "rejection/RepeatedLoops.h"

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(OutlierRejection, Stage, lamp)

namespace lamp {

namespace {

/** Each round makes the solution more certain and so lets in more loops; hardly any after the first
 * few. */
constexpr int kMaxReadmissions = 5;

PoseGraph withLooserOdometry(PoseGraph graph, double scale) {
  for (Edge& edge : graph.edges())
    if (edge.type == EdgeType::kOdometry) edge.information /= scale;
  return graph;
}

/** Gives a loop the verdict of the edge that it repeats, or keeps it if that edge is never
 * rejected. */
void judgeAlike(EdgeIndex edge, EdgeIndex first, OptimizationResult& result) {
  const auto verdictOf = [&](EdgeIndex e) {
    return std::lower_bound(result.loops.begin(), result.loops.end(), e,
                            [](const LoopVerdict& v, EdgeIndex at) { return v.edge < at; });
  };
  const auto mine = verdictOf(edge), other = verdictOf(first);
  const bool judged = other != result.loops.end() && other->edge == first;
  mine->verdict = judged ? other->verdict : Verdict::kInlier;
  mine->weight = judged ? other->weight : 1.0;
}

}  // namespace

/** Waiting loops are admitted once the solution without them bears them out. */
OptimizationResult BackEnd::optimize(const PoseGraph& graph, Admission admission) const {
  OptimizationResult result = optimizer->optimize(graph, admission.admitted);
  for (int round = 0; round < kMaxReadmissions && result.report.usable; ++round) {
    const std::vector<EdgeIndex> found = borneOut(graph, result, admission);
    if (found.empty()) break;
    for (const EdgeIndex edge : found) {
      admission.admitted[edge] = true;
      admission.waiting[edge] = false;
    }
    const OptimizationReport before = result.report;
    result = optimizer->optimize(graph, admission.admitted);
    result.report.iterations += before.iterations;
    result.report.rounds += before.rounds;
    result.report.initial_cost = before.initial_cost;
  }
  return result;
}

OptimizationResult BackEnd::optimize(const PoseGraph& graph, std::vector<bool> admitted) const {
  const auto repeated = repeatedLoops(graph, admitted);
  for (const auto& [edge, first] : repeated) admitted[edge] = false;
  Admission admission(std::move(admitted));
  for (const auto& rejection : rejections) admission = rejection->reject(graph, admission);
  const double scale = admission.odometry_scale;
  OptimizationResult result = scale > 1.0 ? optimize(withLooserOdometry(graph, scale), admission)
                                          : optimize(graph, admission);
  result.report.odometry_scale = scale;
  result.report.frames = admission.frames;
  for (const auto& [edge, first] : repeated) judgeAlike(edge, first, result);
  return result;
}

}  // namespace lamp
