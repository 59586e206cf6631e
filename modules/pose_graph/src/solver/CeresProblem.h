#pragma once

#include <ceres/cost_function.h>
#include <ceres/manifold.h>

#include <array>
#include <memory>

#include "solver/PoseProblem.h"
#include "solver/PoseTerm.h"

namespace ceres {
class Problem;
}

namespace lamp {

/** A pose problem for Ceres, with its trust region and its sparse Cholesky factorisation. */
template <class Space>
class CeresProblem : public PoseProblem {
 public:
  CeresProblem(const PoseGraph& graph, const std::vector<Pose3>& poses);

  void setPoses(const std::vector<Pose3>& poses) override;
  std::vector<Pose3> poses() const override;
  void setWeight(EdgeIndex edge, double weight) override { terms_[edge].weight = weight; }
  double chi2(EdgeIndex edge) const override;
  /** By our own solver's equations: Ceres offers the covariances of any pairs, but slowly. */
  std::vector<double> leaveOneOut2(const std::vector<EdgeIndex>& edges) override;
  SolveSummary solve(const SolverOptions& options) override;

 private:
  using Block = std::array<double, Space::kSize>;

  void build(ceres::Problem& problem);

  const PoseGraph& graph_;
  std::unique_ptr<ceres::Manifold> pose_manifold_, position_manifold_, tilt_manifold_;
  std::vector<Block> blocks_;
  std::vector<PoseTerm<Space>> terms_;  ///< never grows after construction: costs refer to them
  std::vector<std::unique_ptr<ceres::CostFunction>> costs_;
};

extern template class CeresProblem<Se2>;
extern template class CeresProblem<Se3>;

}  // namespace lamp
