#include "lamp/pose_graph/BackEnd.h"

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(OutlierRejection, Stage, lamp)

namespace lamp {

OptimizationResult BackEnd::optimize(const PoseGraph& graph) const {
  std::vector<bool> admitted(graph.edges().size(), true);
  for (const auto& rejection : rejections) rejection->reject(graph, admitted);
  return optimizer->optimize(graph, admitted);
}

}  // namespace lamp
