#include "PoseProblem.h"

#include "CeresProblem.h"
#include "SparseProblem.h"

namespace lamp {

namespace {

template <class Space>
std::unique_ptr<PoseProblem> make(const std::string& solver, const PoseGraph& graph,
                                  const std::vector<Pose3>& world_T_base) {
  if (solver == "CeresLm") return std::make_unique<CeresProblem<Space>>(graph, world_T_base);
  return std::make_unique<SparseProblem<Space>>(
      graph, world_T_base, solver == "Gn" ? minimizeGaussNewton : minimizeLevenbergMarquardt);
}

}  // namespace

const std::vector<std::string>& solverNames() {
  static const std::vector<std::string> kNames = {"Lm", "Gn", "CeresLm"};
  return kNames;
}

std::unique_ptr<PoseProblem> makePoseProblem(const std::string& solver, const PoseGraph& graph,
                                             const std::vector<Pose3>& world_T_base) {
  if (graph.planar()) return make<Se2>(solver, graph, world_T_base);
  return make<Se3>(solver, graph, world_T_base);
}

}  // namespace lamp
