#include "lamp/pose_graph/BackEnd.h"

#include <algorithm>

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(OutlierRejection, Stage, lamp)

namespace lamp {

namespace {

PoseGraph withLooserOdometry(PoseGraph graph, double scale) {
  for (Edge& edge : graph.edges())
    if (edge.type == EdgeType::kOdometry) edge.information /= scale;
  return graph;
}

}  // namespace

OptimizationResult BackEnd::optimize(const PoseGraph& graph, std::vector<bool> admitted) const {
  double scale = 1.0;
  for (const auto& rejection : rejections) {
    rejection->reject(graph, admitted);
    scale = std::max(scale, rejection->odometryScale());
  }
  OptimizationResult result = scale > 1.0
                                  ? optimizer->optimize(withLooserOdometry(graph, scale), admitted)
                                  : optimizer->optimize(graph, admitted);
  result.report.odometry_scale = scale;
  for (const auto& rejection : rejections) {
    const std::vector<FrameAgreement> agreements = rejection->agreements();
    result.report.frames.insert(result.report.frames.end(), agreements.begin(), agreements.end());
  }
  return result;
}

}  // namespace lamp
