#pragma once

#include "lamp/pose_graph/Optimizer.h"
#include "lamp/pose_graph/SolverOptions.h"

namespace lamp {

struct GncOptions {
  std::string solver = "Lm";
  std::string loss = "TruncatedLeastSquares";
  double inlier_probability = 0.9999;
  double mu_step = 2.5;
  int max_rounds = 100;
  int inner_iterations = 10;
  bool gnc_bias_odom = true;
  bool incremental = true;
  SolverOptions final_solve;

  void visit(OptionVisitor& v);
};

/** What a Gnc remembers of its last solution. */
struct GncMemory {
  std::vector<KeyNodeId> nodes;
  std::vector<Edge> edges;
  std::vector<bool> admitted, inlier;  ///< by edge
  std::vector<Pose3> poses;            ///< by node
  size_t doubtful_loops = 0;           ///< rejected by updates since all loops were last weighed
};

/** Graduated non-convexity over the loop closures; odometry and priors are known inliers.
 *
 * Yang, Antonante, Tzoumas, Carlone, "Graduated Non-Convexity for Robust Spatial Perception: From
 * Non-Minimal Solvers to Global Outlier Rejection", RA-L 2020. It starts at initialGuess(), or at
 * chordalGuess() if that leads to a lower truncated cost. Each round continues from the last
 * solution; where that fits worse than the stated covariances allow, the guess is tried as well.
 * The last stage alternates between solving and judging at the threshold until no verdict changes,
 * and carries the final solve through to convergence. The threshold of a loop is the quantile of
 * the chi-square distribution with as many degrees of freedom as its information matrix has rank.
 *
 * The graduation ends when no weight has changed and the cost is the robust one for all residuals,
 * when it is the robust one for all residuals but those next to the threshold, or when in two
 * rounds running exactly those loops that agree have had a weight. It does not end because the cost
 * stays the same or because all weights are 0 or 1.
 *
 * The last stage also rejects loops without which the truncated cost is lower
 * (PoseProblem::leaveOneOut2()), even if their own residuals are small, and takes back loops with
 * which it is lower, even if theirs are large.
 *
 * If the graph has only grown since the last call, its last solution is updated: starting from the
 * last poses, only the new loops are graduated, while the others keep their weights. The last stage
 * then judges all loops, so that new evidence can reinstate old loops or reject them. Once such
 * updates have rejected a tenth as many loops as there are inliers, all loops are graduated
 * afresh. */
class Gnc : public Optimizer {
  DEFINE_MRPT_OBJECT(Gnc, lamp)

 public:
  explicit Gnc(const GncOptions& options = {}) : options_(options) {}

  using Optimizer::optimize;
  void visit(OptionVisitor& options) override { options_.visit(options); }
  /** \throws std::runtime_error if the estimate of a node from which a chain starts is not finite.
   */
  OptimizationResult optimize(const PoseGraph& graph, const std::vector<bool>& admitted) override;
  void forget() override { memory_ = {}; }

 private:
  GncOptions options_;
  GncMemory memory_;
};

}  // namespace lamp
