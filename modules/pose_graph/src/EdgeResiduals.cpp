#include "lamp/pose_graph/EdgeResiduals.h"

#include "solver/PoseTerm.h"

namespace lamp {

namespace {

template <class Space>
std::vector<double> residuals2(const PoseGraph& graph, const std::vector<Pose3>& world_T_base) {
  std::vector<typename Space::Pose> poses;
  for (const Pose3& pose : world_T_base) poses.push_back(Space::fromPose3(pose));
  for (const Landmark& landmark : graph.landmarks())
    poses.push_back(Space::fromPose3(Pose3(Eigen::Translation3d(landmark.world_p))));
  std::vector<double> result;
  for (const PoseTerm<Space>& term : poseTerms<Space>(graph))
    result.push_back(term.chi2(poses[term.from], poses[term.to]));
  return result;
}

}  // namespace

std::vector<double> edgeResiduals2(const PoseGraph& graph, const std::vector<Pose3>& world_T_base) {
  return graph.planar() ? residuals2<Se2>(graph, world_T_base)
                        : residuals2<Se3>(graph, world_T_base);
}

}  // namespace lamp
