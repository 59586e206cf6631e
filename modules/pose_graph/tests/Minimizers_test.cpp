#include "solver/Minimizers.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace lamp {
namespace {

/** Dense problems of two unknowns, by residuals and their Jacobian. */
class Toy : public LeastSquares {
 public:
  explicit Toy(const Eigen::Vector2d& start) : x(start) {}

  virtual Eigen::Vector2d residuals(const Eigen::Vector2d& at) const = 0;
  virtual Eigen::Matrix2d jacobian(const Eigen::Vector2d& at) const = 0;

  double linearize() override { return cost(x); }
  std::optional<double> computeStep(double damping) override {
    const Eigen::Matrix2d J = jacobian(x), H = J.transpose() * J;
    Eigen::Matrix2d damped = H;
    damped.diagonal() *= 1.0 + damping;
    const Eigen::LLT<Eigen::Matrix2d> llt(damped);
    if (llt.info() != Eigen::Success) return std::nullopt;
    const Eigen::Vector2d gradient = J.transpose() * residuals(x);
    step_ = -llt.solve(gradient);
    return -gradient.dot(step_) - 0.5 * step_.dot(H * step_);
  }
  double costAfterStep() override { return cost(x + step_); }
  void acceptStep() override { x += step_; }

  Eigen::Vector2d x;

 private:
  double cost(const Eigen::Vector2d& at) const { return 0.5 * residuals(at).squaredNorm(); }
  Eigen::Vector2d step_;
};

/** Least at (1, 1), along a bent valley. */
class Rosenbrock : public Toy {
 public:
  using Toy::Toy;
  Eigen::Vector2d residuals(const Eigen::Vector2d& p) const override {
    return {10 * (p.y() - p.x() * p.x()), 1 - p.x()};
  }
  Eigen::Matrix2d jacobian(const Eigen::Vector2d& p) const override {
    return (Eigen::Matrix2d() << -20 * p.x(), 10, -1, 0).finished();
  }
};

/** The arc tangent, on which Gauss-Newton steps overshoot further and further. */
class ArcTangent : public Toy {
 public:
  using Toy::Toy;
  Eigen::Vector2d residuals(const Eigen::Vector2d& p) const override {
    return p.array().atan().matrix();
  }
  Eigen::Matrix2d jacobian(const Eigen::Vector2d& p) const override {
    return (1.0 / (1.0 + p.array().square())).matrix().asDiagonal();
  }
};

/** Knows the sum of its unknowns only. */
class Sum : public Toy {
 public:
  using Toy::Toy;
  Eigen::Vector2d residuals(const Eigen::Vector2d& p) const override { return {p.sum() - 3, 0}; }
  Eigen::Matrix2d jacobian(const Eigen::Vector2d&) const override {
    return (Eigen::Matrix2d() << 1, 1, 0, 0).finished();
  }
};

TEST(Minimizers, LevenbergMarquardtFollowsTheValley) {
  Rosenbrock problem({-1.2, 1});
  const SolveSummary summary = minimizeLevenbergMarquardt(problem, {});
  EXPECT_TRUE(summary.usable);
  EXPECT_NE(summary.termination.find("converged"), std::string::npos);
  EXPECT_NEAR(summary.initial_cost, 12.1, 1e-9);
  EXPECT_LT((problem.x - Eigen::Vector2d(1, 1)).norm(), 1e-6);
}

TEST(Minimizers, LevenbergMarquardtTakesNoStepThatRaisesTheCost) {
  ArcTangent problem({2, -3});
  EXPECT_LT(minimizeLevenbergMarquardt(problem, {}).final_cost, 1e-12);
  EXPECT_LT(problem.x.norm(), 1e-6);
}

TEST(Minimizers, GaussNewtonSaysThatItDiverged) {
  ArcTangent problem({2, -3});
  const SolveSummary summary = minimizeGaussNewton(problem, {});
  EXPECT_FALSE(summary.usable);
}

TEST(Minimizers, GaussNewtonSaysThatTheProblemIsSingular) {
  Sum problem({0, 0});
  const SolveSummary summary = minimizeGaussNewton(problem, {});
  EXPECT_FALSE(summary.usable);
  EXPECT_NE(summary.termination.find("singular"), std::string::npos);
}

TEST(Minimizers, LevenbergMarquardtSolvesWhatIsSingular) {
  Sum problem({0, 1});
  EXPECT_LT(minimizeLevenbergMarquardt(problem, {}).final_cost, 1e-9);
  EXPECT_NEAR(problem.x.sum(), 3.0, 1e-5);
}

TEST(Minimizers, LimitOfIterationsIsReported) {
  Rosenbrock problem({-1.2, 1});
  SolverOptions options;
  options.max_iterations = 2;
  const SolveSummary summary = minimizeLevenbergMarquardt(problem, options);
  EXPECT_EQ(summary.iterations, 2);
  EXPECT_TRUE(summary.usable);
  EXPECT_NE(summary.termination.find("max_iterations"), std::string::npos);
}

}  // namespace
}  // namespace lamp
