#pragma once

#include <optional>

#include "solver/PoseProblem.h"

namespace lamp {

/** A nonlinear least-squares problem as the minimisers see it. Costs are half the sums of
 * squares. */
class LeastSquares {
 public:
  virtual ~LeastSquares() = default;

  /** Sets up the normal equations H d = -g at the estimate. \return the cost there. */
  virtual double linearize() = 0;
  /** Solves (H + damping · D) d = -g, D the diagonal of H.
   * \return by how much d lowers the linearised cost; none if the matrix is singular. */
  virtual std::optional<double> computeStep(double damping) = 0;
  /** The cost after the last step. */
  virtual double costAfterStep() = 0;
  /** Moves the estimate by the last step. */
  virtual void acceptStep() = 0;
};

/** Levenberg-Marquardt with Nielsen's rule for the damping (Madsen, Nielsen, Tingleff, "Methods for
 * non-linear least squares problems", 2004, algorithm 3.16), which follows the gain ratio. */
SolveSummary minimizeLevenbergMarquardt(LeastSquares& problem, const SolverOptions& options);

/** Gauss-Newton: every step is taken. */
SolveSummary minimizeGaussNewton(LeastSquares& problem, const SolverOptions& options);

}  // namespace lamp
