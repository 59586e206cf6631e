#include "solver/Minimizers.h"

#include <algorithm>
#include <cmath>

namespace lamp {

namespace {

/** So small that the first steps are Gauss-Newton steps, unless those fail. */
constexpr double kFirstDamping = 1e-12;
/** A smaller damping hardly changes a step that has failed. */
constexpr double kLeastUseful = 1e-8;
constexpr double kMaxDamping = 1e16;
/** A sum of squared Mahalanobis distances that is nothing but rounding. */
constexpr double kNoCost = 1e-15;

const char* const kConverged = "converged: the cost falls by less than function_tolerance";
const char* const kLimit = "stopped at max_iterations";

bool negligible(double decrease, double cost, const SolverOptions& options) {
  return decrease <= options.function_tolerance * cost + kNoCost;
}

/** The damping of the next step. */
class Damping {
 public:
  double value() const { return value_; }
  bool exhausted() const { return value_ > kMaxDamping; }

  void accepted(double gain_ratio) {
    const double distrust = 1.0 - std::pow(2.0 * gain_ratio - 1.0, 3);
    value_ *= std::clamp(distrust, 1.0 / 3.0, 2.0);
    growth_ = 2.0;
  }
  void rejected() {
    value_ = std::max(value_ * growth_, kLeastUseful);
    growth_ *= 2.0;
  }

 private:
  double value_ = kFirstDamping;
  double growth_ = 2.0;
};

}  // namespace

SolveSummary minimizeLevenbergMarquardt(LeastSquares& problem, const SolverOptions& options) {
  SolveSummary summary;
  double cost = problem.linearize();
  summary.initial_cost = summary.final_cost = cost;
  summary.usable = std::isfinite(cost);
  summary.termination = summary.usable ? kLimit : "the cost at the start is not finite";
  Damping damping;
  while (summary.usable && summary.iterations < options.max_iterations) {
    ++summary.iterations;
    const std::optional<double> predicted = problem.computeStep(damping.value());
    if (predicted && negligible(*predicted, cost, options)) {
      summary.termination = kConverged;
      break;
    }
    const double decrease = predicted ? cost - problem.costAfterStep() : 0.0;
    if (decrease > 0) {
      problem.acceptStep();
      damping.accepted(decrease / *predicted);
      const bool converged = negligible(decrease, cost, options);
      summary.final_cost = cost - decrease;
      if (converged) {
        summary.termination = kConverged;
        break;
      }
      cost = problem.linearize();
      continue;
    }
    damping.rejected();
    if (damping.exhausted()) {
      summary.termination = "stopped: no step lowers the cost";
      break;
    }
  }
  return summary;
}

SolveSummary minimizeGaussNewton(LeastSquares& problem, const SolverOptions& options) {
  SolveSummary summary;
  double cost = problem.linearize();
  summary.initial_cost = summary.final_cost = cost;
  summary.termination = kLimit;
  while (summary.iterations < options.max_iterations) {
    ++summary.iterations;
    const std::optional<double> predicted = problem.computeStep(0.0);
    if (!predicted) {
      summary.usable = false;
      summary.termination = "the normal equations are singular";
      return summary;
    }
    if (negligible(*predicted, cost, options)) {
      summary.termination = kConverged;
      break;
    }
    problem.acceptStep();
    cost = problem.linearize();
    summary.final_cost = cost;
  }
  summary.usable = cost <= summary.initial_cost;
  if (!summary.usable) summary.termination = "the cost has grown";
  return summary;
}

}  // namespace lamp
