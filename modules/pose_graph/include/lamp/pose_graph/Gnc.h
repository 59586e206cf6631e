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

/** The last solution of a Gnc. */
struct GncMemory {
  std::vector<KeyNodeId> nodes;
  std::vector<Edge> edges;
  std::vector<bool> admitted, inlier;  ///< of each edge
  std::vector<Pose3> poses;            ///< of each node
  size_t doubtful_loops = 0;           ///< rejected since all loops were weighed together
};

/** Graduated non-convexity over the loop closures; odometry and priors are known inliers.
 *
 * Yang, Antonante, Tzoumas, Carlone, "Graduated Non-Convexity for Robust Spatial Perception: From
 * Non-Minimal Solvers to Global Outlier Rejection", RA-L 2020. The first start is initialGuess(),
 * or chordalGuess() if that leads to a lower truncated cost. Rounds go on from the last solution;
 * where that fits worse than the stated covariances let it, the guess is tried, too. A last stage
 * alternates solves with verdicts at the threshold until they agree, the last solve in full. The
 * threshold of a loop is the quantile of the chi-square distribution with as many degrees of
 * freedom as its information matrix has rank.
 *
 * A round ends the graduation only if no weight has changed in it and the cost is the robust one
 * for all residuals, or for all but those next to the threshold, or if it is the second in which
 * just those loops have a weight that agree; not because the cost stays, nor because all weights
 * are 0 or 1.
 *
 * The last stage also rejects loops without which the truncated cost is lower
 * (PoseProblem::leaveOneOut2()), though their own residuals may be small, and takes those in again
 * with which it is lower, though theirs may be large.
 *
 * A graph that has grown since the last call is updated: only the new loops are graduated, from the
 * last poses, among loops that keep their weights; the last stage then judges all loops, so that
 * old ones come back, or go, where the new ones say so. When such updates have rejected a tenth as
 * many loops as there are inliers, all loops are graduated anew. */
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
