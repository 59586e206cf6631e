#include "lamp/pose_graph/EdgeResiduals.h"

#include "PoseTerm.h"

namespace lamp {

namespace {

template <class Space>
std::vector<double> residuals2(const PoseGraph& graph, const std::vector<Pose3>& world_T_base) {
  std::vector<double> result;
  for (const PoseTerm<Space>& term : poseTerms<Space>(graph))
    result.push_back(term.chi2(Space::fromPose3(world_T_base[term.from]),
                               Space::fromPose3(world_T_base[term.to])));
  return result;
}

}  // namespace

std::vector<double> edgeResiduals2(const PoseGraph& graph, const std::vector<Pose3>& world_T_base) {
  return graph.planar() ? residuals2<Se2>(graph, world_T_base)
                        : residuals2<Se3>(graph, world_T_base);
}

}  // namespace lamp
