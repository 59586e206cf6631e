#pragma once

#include <memory>
#include <optional>

#include "solver/BlockCholesky.h"
#include "solver/Minimizers.h"
#include "solver/NormalEquations.h"
#include "solver/PoseProblem.h"

namespace lamp {

/** A pose problem for our own sparse block solver.
 *
 * A step moves each pose by itself. If the cost falls by less than half of what the linearised
 * problem promised, the step is also tried as changes to the links of odometry, from the first key
 * node on: a long piece that turns about a distant point then keeps its length instead of being
 * stretched along the tangent (on such a state space: Olson, Leonard, Teller, "Fast iterative
 * alignment of pose graphs with poor initial estimates", ICRA 2006). To first order both are the
 * same; the one with the lower cost is taken. */
template <class Space>
class SparseProblem : public PoseProblem, private LeastSquares {
 public:
  using Minimizer = SolveSummary (*)(LeastSquares&, const SolverOptions&);

  SparseProblem(const PoseGraph& graph, const std::vector<Pose3>& poses, Minimizer minimizer);

  void setPoses(const std::vector<Pose3>& poses) override;
  std::vector<Pose3> poses() const override;
  void setWeight(EdgeIndex edge, double weight) override;
  double chi2(EdgeIndex edge) const override {
    return terms_[edge].chi2(poses_[terms_[edge].from], poses_[terms_[edge].to]);
  }
  std::vector<double> leaveOneOut2(const std::vector<EdgeIndex>& edges) override;
  SolveSummary solve(const SolverOptions& options) override;

 private:
  using Pose = typename Space::Pose;

  /** Damping so small that the damped equations are as good as the undamped ones. */
  static constexpr double kNoDamping = 1e-9;

  void build();
  bool factorize(double damping);
  double linearize() override { return cost_ = equations_->linearize(poses_); }
  std::optional<double> computeStep(double damping) override;
  double costAfterStep() override;
  void acceptStep() override {
    poses_ = moved_;
    factorized_here_ = false;
  }
  void move();
  std::vector<Pose> movedAsChains() const;

  const PoseGraph& graph_;
  const Minimizer minimize_;
  std::vector<PoseTerm<Space>> terms_;
  std::vector<Pose> poses_;
  std::vector<Pose> moved_;  ///< by the last step
  std::vector<int> row_;     ///< of each pose in the equations, -1 for held ones
  std::unique_ptr<NormalEquations<Space>> equations_;  ///< null if the structure has changed
  std::unique_ptr<BlockCholesky<Space::kDof>> cholesky_;
  bool factorized_here_ = false;  ///< cholesky_ is that of the undamped equations at poses_
  Eigen::VectorXd step_;
  double cost_ = 0;       ///< at poses_
  double predicted_ = 0;  ///< by how much the step lowers the linearised cost
};

extern template class SparseProblem<Se2>;
extern template class SparseProblem<Se3>;

}  // namespace lamp
