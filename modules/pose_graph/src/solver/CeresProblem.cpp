#include "solver/CeresProblem.h"

#include <ceres/ceres.h>

#include <cmath>

#include "solver/FinitePoses.h"
#include "solver/SparseProblem.h"
#include "solver/SquareRoot.h"
#include "solver/Unknowns.h"

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
 * with zero columns; the "plus Jacobian" only has to cut the padding off.
 * \tparam kDof how many of the tangent's coordinates move, from the first on. */
template <class Space, int kDof>
class PoseManifold : public ceres::Manifold {
 public:
  int AmbientSize() const override { return Space::kSize; }
  int TangentSize() const override { return kDof; }

  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    typename Space::Tangent d = Space::Tangent::Zero();
    d.template head<kDof>() = Eigen::Map<const Eigen::Matrix<double, kDof, 1>>(delta);
    Space::store(Space::plus(Space::load(x), d), x_plus_delta);
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    setIdentity<Space::kSize, kDof>(jacobian);
    return true;
  }
  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    Eigen::Map<Eigen::Matrix<double, kDof, 1>> difference(y_minus_x);
    difference = Space::minus(Space::load(y), Space::load(x)).template head<kDof>();
    return true;
  }
  bool MinusJacobian(const double*, double* jacobian) const override {
    setIdentity<kDof, Space::kSize>(jacobian);
    return true;
  }
};

/** Rotations of a pose in space about the world's horizontal axes; the position stays. */
class TiltManifold : public ceres::Manifold {
 public:
  int AmbientSize() const override { return Se3::kSize; }
  int TangentSize() const override { return 2; }

  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    Pose3 T = Se3::load(x);
    T.linear() = turn(delta[0], delta[1]) * T.linear();
    Se3::store(T, x_plus_delta);
    return true;
  }
  bool PlusJacobian(const double* x, double* jacobian) const override {
    // A rotation d in the world is Rᵀ d in the pose's own frame.
    Eigen::Map<Eigen::Matrix<double, Se3::kSize, 2, Eigen::RowMajor>> J(jacobian);
    J.setZero();
    J.middleRows<3>(3) = Se3::load(x).linear().transpose().leftCols<2>();
    return true;
  }
  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    Pose3 turned = Pose3::Identity();
    turned.linear() = Se3::load(y).linear() * Se3::load(x).linear().transpose();
    Eigen::Map<Eigen::Vector2d> difference(y_minus_x);
    difference = logSE3(turned).segment<2>(3);
    return true;
  }
  bool MinusJacobian(const double* x, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 2, Se3::kSize, Eigen::RowMajor>> J(jacobian);
    J.setZero();
    J.middleCols<3>(3) = Se3::load(x).linear().topRows<2>();
    return true;
  }

 private:
  static Eigen::Matrix3d turn(double x, double y) {
    Vector6d d = Vector6d::Zero();
    d.segment<2>(3) << x, y;
    return expSE3(d).linear();
  }
};

/** Writes a tangent-space Jacobian into a row-major block that is padded with zero columns. */
template <class Space>
void storeJacobian(const typename Space::Jacobian& jacobian, double* block) {
  Eigen::Map<Eigen::Matrix<double, Space::kDof, Space::kSize, Eigen::RowMajor>> padded(block);
  padded.setZero();
  padded.template leftCols<Space::kDof>() = jacobian;
}

/** A term of two poses. */
template <class Space>
class BinaryCost : public ceres::SizedCostFunction<Space::kDof, Space::kSize, Space::kSize> {
 public:
  explicit BinaryCost(const PoseTerm<Space>& term)
      : term_(term), root_(squareRoot(term.information)) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    using Jacobian = typename Space::Jacobian;
    const bool want_from = jacobians && jacobians[0], want_to = jacobians && jacobians[1];
    Jacobian d_from, d_to;
    const typename Space::Tangent error =
        term_.error(Space::load(blocks[0]), Space::load(blocks[1]), want_from ? &d_from : nullptr,
                    want_to ? &d_to : nullptr);
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
class UnaryCost : public ceres::SizedCostFunction<Space::kDof, Space::kSize> {
 public:
  explicit UnaryCost(const PoseTerm<Space>& term)
      : term_(term), root_(squareRoot(term.information)) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    using Jacobian = typename Space::Jacobian;
    const bool want = jacobians && jacobians[0];
    const typename Space::Pose pose = Space::load(blocks[0]);
    Jacobian d_pose;
    const typename Space::Tangent error =
        term_.error(pose, pose, nullptr, want ? &d_pose : nullptr);
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
CeresProblem<Space>::CeresProblem(const PoseGraph& graph, const std::vector<Pose3>& poses)
    : graph_(graph),
      pose_manifold_(std::make_unique<PoseManifold<Space, Space::kDof>>()),
      position_manifold_(std::make_unique<PoseManifold<Space, Space::kPositionDof>>()),
      tilt_manifold_(std::make_unique<TiltManifold>()),
      blocks_(graph.nodes().size() + graph.landmarks().size()),
      terms_(poseTerms<Space>(graph)) {
  for (const PoseTerm<Space>& term : terms_) {
    if (term.isUnary())
      costs_.push_back(std::make_unique<UnaryCost<Space>>(term));
    else
      costs_.push_back(std::make_unique<BinaryCost<Space>>(term));
  }
  setPoses(poses);
}

template <class Space>
void CeresProblem<Space>::setPoses(const std::vector<Pose3>& poses) {
  checkFinite(graph_, poses);
  for (size_t i = 0; i < blocks_.size(); ++i)
    Space::store(Space::fromPose3(poses[i]), blocks_[i].data());
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
std::vector<double> CeresProblem<Space>::leaveOneOut2(const std::vector<EdgeIndex>& edges) {
  SparseProblem<Space> twin(graph_, poses(), minimizeGaussNewton);
  for (EdgeIndex e = 0; e < terms_.size(); ++e) twin.setWeight(e, terms_[e].weight);
  return twin.leaveOneOut2(edges);
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
  std::vector<double> weights;
  for (const PoseTerm<Space>& term : terms_) weights.push_back(term.weight);
  const Unknowns unknowns = findUnknowns(graph_, weights);
  const size_t nodes = graph_.nodes().size();
  for (size_t i = 0; i < blocks_.size(); ++i) {
    double* const block = blocks_[i].data();
    const auto& manifold = i < nodes ? pose_manifold_ : position_manifold_;
    problem.AddParameterBlock(block, Space::kSize, manifold.get());
    if (unknowns.row[i] < 0) problem.SetParameterBlockConstant(block);
  }
  for (const size_t anchor : unknowns.level_anchors)
    problem.SetManifold(blocks_[anchor].data(), tilt_manifold_.get());
  for (size_t e = 0; e < terms_.size(); ++e) {
    const PoseTerm<Space>& term = terms_[e];
    if (term.weight <= 0) continue;
    double* const to = blocks_[term.to].data();
    if (term.isUnary())
      problem.AddResidualBlock(costs_[e].get(), nullptr, to);
    else
      problem.AddResidualBlock(costs_[e].get(), nullptr, blocks_[term.from].data(), to);
  }
}

template class CeresProblem<Se2>;
template class CeresProblem<Se3>;

}  // namespace lamp
