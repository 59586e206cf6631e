#pragma once

#include "lamp/pose_graph/Optimizer.h"
#include "lamp/pose_graph/SolverOptions.h"

namespace lamp {

struct GncOptions {
  std::string solver = "Lm";
  double inlier_probability = 0.9999;
  double mu_step = 1.4;
  int max_rounds = 100;
  int inner_iterations = 6;
  SolverOptions final_solve;

  void visit(OptionVisitor& v);
};

/** Graduated non-convexity with truncated least squares over the loop closures; odometry and priors
 * are known inliers.
 *
 * Yang, Antonante, Tzoumas, Carlone, "Graduated Non-Convexity for Robust Spatial Perception: From
 * Non-Minimal Solvers to Global Outlier Rejection", RA-L 2020. Unlike there, each round starts
 * again from initialGuess(): a start at the last round's solution, which outliers have distorted,
 * loses true loops. A last stage alternates full solves with verdicts at the threshold until they
 * agree.
 *
 * Every loop takes part, whatever its verdict was before. */
class Gnc : public Optimizer {
  DEFINE_MRPT_OBJECT(Gnc, lamp)

 public:
  explicit Gnc(const GncOptions& options = {}) : options_(options) {}

  void visit(OptionVisitor& options) override { options_.visit(options); }
  /** \throws std::runtime_error if the estimate of a node from which a chain starts is not finite.
   */
  OptimizationResult optimize(const PoseGraph& graph) override;

 private:
  GncOptions options_;
};

}  // namespace lamp
