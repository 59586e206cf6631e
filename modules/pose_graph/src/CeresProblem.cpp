#include "CeresProblem.h"

#include <ceres/ceres.h>

#include <cmath>

#include "FinitePoses.h"
#include "GaugeAnchors.h"
#include "SquareRoot.h"

namespace lamp {

namespace {

/** A rectangular matrix with ones on its diagonal. */
template <int kRows, int kColumns>
void setIdentity(double* row_major) {
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      row_major[row * kColumns + column] = row == column ? 1.0 : 0.0;
}

/** Right perturbation of a pose. Cost functions give their Jacobians in the tangent space, padded
 * with zero columns; the "plus Jacobian" only has to cut the padding off. */
template <class Space>
class PoseManifold : public ceres::Manifold {
 public:
  int AmbientSize() const override { return Space::kSize; }
  int TangentSize() const override { return Space::kDof; }

  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    const typename Space::Tangent d = Eigen::Map<const typename Space::Tangent>(delta);
    Space::store(Space::plus(Space::load(x), d), x_plus_delta);
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    setIdentity<Space::kSize, Space::kDof>(jacobian);
    return true;
  }
  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    Eigen::Map<typename Space::Tangent> difference(y_minus_x);
    difference = Space::minus(Space::load(y), Space::load(x));
    return true;
  }
  bool MinusJacobian(const double*, double* jacobian) const override {
    setIdentity<Space::kDof, Space::kSize>(jacobian);
    return true;
  }
};

/** Writes a tangent-space Jacobian into a row-major block that is padded with zero columns. */
template <class Space>
void storeJacobian(const typename Space::Jacobian& jacobian, double* block) {
  Eigen::Map<Eigen::Matrix<double, Space::kDof, Space::kSize, Eigen::RowMajor>> padded(block);
  padded.setZero();
  padded.template leftCols<Space::kDof>() = jacobian;
}

template <class Space>
class RelativeCost : public ceres::SizedCostFunction<Space::kDof, Space::kSize, Space::kSize> {
 public:
  explicit RelativeCost(const PoseTerm<Space>& term)
      : term_(term), root_(squareRoot(term.information)) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    using Jacobian = typename Space::Jacobian;
    const bool want_from = jacobians && jacobians[0], want_to = jacobians && jacobians[1];
    Jacobian d_from, d_to;
    const typename Space::Tangent error =
        Space::relativeError(term_.measured, Space::load(blocks[0]), Space::load(blocks[1]),
                             want_from ? &d_from : nullptr, want_to ? &d_to : nullptr);
    const Jacobian root = std::sqrt(term_.weight) * root_;
    Eigen::Map<typename Space::Tangent> whitened(residuals);
    whitened = root * error;
    if (want_from) storeJacobian<Space>(root * d_from, jacobians[0]);
    if (want_to) storeJacobian<Space>(root * d_to, jacobians[1]);
    return true;
  }

 private:
  const PoseTerm<Space>& term_;
  const typename Space::Jacobian root_;
};

template <class Space>
class PriorCost : public ceres::SizedCostFunction<Space::kDof, Space::kSize> {
 public:
  explicit PriorCost(const PoseTerm<Space>& term)
      : term_(term), root_(squareRoot(term.information)) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    using Jacobian = typename Space::Jacobian;
    const bool want = jacobians && jacobians[0];
    Jacobian d_pose;
    const typename Space::Tangent error =
        Space::priorError(term_.measured, Space::load(blocks[0]), want ? &d_pose : nullptr);
    const Jacobian root = std::sqrt(term_.weight) * root_;
    Eigen::Map<typename Space::Tangent> whitened(residuals);
    whitened = root * error;
    if (want) storeJacobian<Space>(root * d_pose, jacobians[0]);
    return true;
  }

 private:
  const PoseTerm<Space>& term_;
  const typename Space::Jacobian root_;
};

/** So large that the first steps are Gauss-Newton steps: the default takes twice the time. */
constexpr double kTrustRegionRadius = 1e12;

ceres::Solver::Options solverOptions(const SolverOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  solver.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.function_tolerance;
  solver.initial_trust_region_radius = kTrustRegionRadius;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  return solver;
}

ceres::Problem::Options problemOptions() {
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.disable_all_safety_checks = true;
  return options;
}

}  // namespace

template <class Space>
CeresProblem<Space>::CeresProblem(const PoseGraph& graph, const std::vector<Pose3>& world_T_base)
    : graph_(graph),
      manifold_(std::make_unique<PoseManifold<Space>>()),
      blocks_(graph.nodes().size()),
      terms_(poseTerms<Space>(graph)) {
  for (const PoseTerm<Space>& term : terms_) {
    if (term.prior)
      costs_.push_back(std::make_unique<PriorCost<Space>>(term));
    else
      costs_.push_back(std::make_unique<RelativeCost<Space>>(term));
  }
  setPoses(world_T_base);
}

template <class Space>
void CeresProblem<Space>::setPoses(const std::vector<Pose3>& world_T_base) {
  checkFinite(graph_, world_T_base);
  for (size_t i = 0; i < blocks_.size(); ++i)
    Space::store(Space::fromPose3(world_T_base[i]), blocks_[i].data());
}

template <class Space>
std::vector<Pose3> CeresProblem<Space>::poses() const {
  std::vector<Pose3> result;
  for (const Block& block : blocks_) result.push_back(Space::toPose3(Space::load(block.data())));
  return result;
}

template <class Space>
double CeresProblem<Space>::chi2(EdgeIndex edge) const {
  const PoseTerm<Space>& term = terms_[edge];
  return term.chi2(Space::load(blocks_[term.from].data()), Space::load(blocks_[term.to].data()));
}

template <class Space>
SolveSummary CeresProblem<Space>::solve(const SolverOptions& options) {
  ceres::Problem problem(problemOptions());
  build(problem);
  ceres::Solver::Summary summary;
  ceres::Solve(solverOptions(options), &problem, &summary);
  return {summary.IsSolutionUsable(), summary.message,
          summary.num_successful_steps + summary.num_unsuccessful_steps, summary.initial_cost,
          summary.final_cost};
}

template <class Space>
void CeresProblem<Space>::build(ceres::Problem& problem) {
  for (Block& block : blocks_)
    problem.AddParameterBlock(block.data(), Space::kSize, manifold_.get());
  std::vector<double> weights;
  for (size_t e = 0; e < terms_.size(); ++e) {
    const PoseTerm<Space>& term = terms_[e];
    weights.push_back(term.weight);
    if (term.weight <= 0) continue;
    double* const from = blocks_[term.from].data();
    if (term.prior)
      problem.AddResidualBlock(costs_[e].get(), nullptr, from);
    else
      problem.AddResidualBlock(costs_[e].get(), nullptr, from, blocks_[term.to].data());
  }
  for (const size_t anchor : gaugeAnchors(graph_, weights))
    problem.SetParameterBlockConstant(blocks_[anchor].data());
}

template class CeresProblem<Se2>;
template class CeresProblem<Se3>;

}  // namespace lamp
