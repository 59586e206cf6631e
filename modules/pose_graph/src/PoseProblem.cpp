#include "PoseProblem.h"

#include <ceres/ceres.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "GaugeAnchors.h"
#include "PoseSpaces.h"
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

/** An edge of the graph, ready for evaluation. */
template <class Space>
struct Term {
  bool prior;
  size_t from, to;  ///< places in PoseGraph::nodes()
  typename Space::Pose measured;
  typename Space::Jacobian root;  ///< of the information matrix
  double weight = 1.0;
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
  explicit RelativeCost(const Term<Space>& term) : term_(term) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    using Jacobian = typename Space::Jacobian;
    const bool want_from = jacobians && jacobians[0], want_to = jacobians && jacobians[1];
    Jacobian d_from, d_to;
    const typename Space::Tangent error =
        Space::relativeError(term_.measured, Space::load(blocks[0]), Space::load(blocks[1]),
                             want_from ? &d_from : nullptr, want_to ? &d_to : nullptr);
    const Jacobian root = std::sqrt(term_.weight) * term_.root;
    Eigen::Map<typename Space::Tangent> whitened(residuals);
    whitened = root * error;
    if (want_from) storeJacobian<Space>(root * d_from, jacobians[0]);
    if (want_to) storeJacobian<Space>(root * d_to, jacobians[1]);
    return true;
  }

 private:
  const Term<Space>& term_;
};

template <class Space>
class PriorCost : public ceres::SizedCostFunction<Space::kDof, Space::kSize> {
 public:
  explicit PriorCost(const Term<Space>& term) : term_(term) {}

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    using Jacobian = typename Space::Jacobian;
    const bool want = jacobians && jacobians[0];
    Jacobian d_pose;
    const typename Space::Tangent error =
        Space::priorError(term_.measured, Space::load(blocks[0]), want ? &d_pose : nullptr);
    const Jacobian root = std::sqrt(term_.weight) * term_.root;
    Eigen::Map<typename Space::Tangent> whitened(residuals);
    whitened = root * error;
    if (want) storeJacobian<Space>(root * d_pose, jacobians[0]);
    return true;
  }

 private:
  const Term<Space>& term_;
};

ceres::Solver::Options solverOptions(const LmOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  solver.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.function_tolerance;
  solver.initial_trust_region_radius = options.initial_trust_region_radius;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  return solver;
}

template <class Space>
class SpaceProblem : public PoseProblem {
 public:
  SpaceProblem(const PoseGraph& graph, const std::vector<Pose3>& world_T_base)
      : graph_(graph), blocks_(graph.nodes().size()) {
    terms_.reserve(graph.edges().size());
    for (const Edge& edge : graph.edges()) addTerm(edge);
    setPoses(world_T_base);
  }

  int degreesOfFreedom() const override { return Space::kDof; }

  void setPoses(const std::vector<Pose3>& world_T_base) override {
    for (size_t i = 0; i < blocks_.size(); ++i) {
      if (!isFinite(world_T_base[i])) throwNotFinite(graph_.nodes()[i].id);
      Space::store(Space::fromPose3(world_T_base[i]), blocks_[i].data());
    }
  }

  std::vector<Pose3> poses() const override {
    std::vector<Pose3> result;
    for (const Block& block : blocks_) result.push_back(Space::toPose3(Space::load(block.data())));
    return result;
  }

  void setWeight(EdgeIndex edge, double weight) override { terms_[edge].weight = weight; }

  double chi2(EdgeIndex edge) const override {
    const Term<Space>& term = terms_[edge];
    const typename Space::Pose from = Space::load(blocks_[term.from].data());
    const typename Space::Tangent error =
        term.prior ? Space::priorError(term.measured, from, nullptr)
                   : Space::relativeError(term.measured, from, Space::load(blocks_[term.to].data()),
                                          nullptr, nullptr);
    return (term.root * error).squaredNorm();
  }

  SolveSummary solve(const LmOptions& options) override {
    ceres::Problem problem(problemOptions());
    build(problem);
    ceres::Solver::Summary summary;
    ceres::Solve(solverOptions(options), &problem, &summary);
    return {summary.IsSolutionUsable(), summary.message,
            summary.num_successful_steps + summary.num_unsuccessful_steps, summary.initial_cost,
            summary.final_cost};
  }

 private:
  using Block = std::array<double, Space::kSize>;

  [[noreturn]] static void throwNotFinite(KeyframeId id) {
    throw std::runtime_error("optimizer: the pose of key node " + std::to_string(id.index) +
                             " of robot " + std::to_string(id.robot.value) +
                             " is not finite; give it a finite estimate before optimising");
  }

  void addTerm(const Edge& edge) {
    const bool prior = edge.type == EdgeType::kPrior;
    terms_.push_back({prior, graph_.place(edge.from), graph_.place(edge.to),
                      Space::fromPose3(normalized(edge.from_T_to)),
                      squareRoot(Space::information(edge.information))});
    const Term<Space>& term = terms_.back();
    if (prior)
      costs_.push_back(std::make_unique<PriorCost<Space>>(term));
    else
      costs_.push_back(std::make_unique<RelativeCost<Space>>(term));
  }

  static ceres::Problem::Options problemOptions() {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.disable_all_safety_checks = true;
    return options;
  }

  void build(ceres::Problem& problem) {
    for (Block& block : blocks_) problem.AddParameterBlock(block.data(), Space::kSize, &manifold_);
    std::vector<double> weights;
    for (size_t e = 0; e < terms_.size(); ++e) {
      const Term<Space>& term = terms_[e];
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

  const PoseGraph& graph_;
  PoseManifold<Space> manifold_;
  std::vector<Block> blocks_;
  std::vector<Term<Space>> terms_;  ///< never grows after construction: costs refer to them
  std::vector<std::unique_ptr<ceres::CostFunction>> costs_;
};

}  // namespace

std::unique_ptr<PoseProblem> makePoseProblem(const PoseGraph& graph,
                                             const std::vector<Pose3>& world_T_base) {
  if (graph.planar()) return std::make_unique<SpaceProblem<Se2>>(graph, world_T_base);
  return std::make_unique<SpaceProblem<Se3>>(graph, world_T_base);
}

}  // namespace lamp
