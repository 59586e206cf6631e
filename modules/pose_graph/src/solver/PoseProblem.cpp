#include "solver/PoseProblem.h"

#include "solver/CeresProblem.h"
#include "solver/SparseProblem.h"

namespace lamp {

namespace {

template <class Space>
std::unique_ptr<PoseProblem> make(const std::string& solver, const PoseGraph& graph,
                                  const std::vector<Pose3>& poses) {
  if (solver == "CeresLm") return std::make_unique<CeresProblem<Space>>(graph, poses);
  return std::make_unique<SparseProblem<Space>>(
      graph, poses, solver == "Gn" ? minimizeGaussNewton : minimizeLevenbergMarquardt);
}

}  // namespace

const std::vector<std::string>& solverNames() {
  static const std::vector<std::string> kNames = {"Lm", "Gn", "CeresLm"};
  return kNames;
}

std::unique_ptr<PoseProblem> makePoseProblem(const std::string& solver, const PoseGraph& graph,
                                             const std::vector<Pose3>& poses) {
  if (graph.planar()) return make<Se2>(solver, graph, poses);
  return make<Se3>(solver, graph, poses);
}

}  // namespace lamp
