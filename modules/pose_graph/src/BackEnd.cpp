#include "lamp/pose_graph/BackEnd.h"

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(OutlierRejection, Stage, lamp)

namespace lamp {

OptimizationResult BackEnd::optimize(const PoseGraph& graph, std::vector<bool> admitted) const {
  for (const auto& rejection : rejections) rejection->reject(graph, admitted);
  OptimizationResult result = optimizer->optimize(graph, admitted);
  for (const auto& rejection : rejections) {
    const std::vector<FrameAgreement> agreements = rejection->agreements();
    result.report.frames.insert(result.report.frames.end(), agreements.begin(), agreements.end());
  }
  return result;
}

}  // namespace lamp
