#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "guess/SolveStart.h"
#include "solver/PoseProblem.h"

namespace lamp {

/** A loop closure, or other edge that may be rejected, in a graduated optimisation. */
struct WeighedLoop {
  EdgeIndex edge;
  double threshold;  ///< the largest squared residual of an inlier
  double weight = 1.0;
  bool graduated = true;  ///< else it keeps its weight until the last stage
  bool left_out = false;  ///< because the truncated cost was lower without it
  bool taken_in = false;  ///< after a rejection, because it promised to lower that cost
};

/** A pose problem, the weights of its loops, and a record of its repeated solves. Squared residuals
 * and distances of loops are in units of their thresholds. */
class WeighedProblem {
 public:
  /** \param start whose admitted edges take part, with weight 1 at first. All must outlive this. */
  WeighedProblem(const PoseGraph& graph, const SolveStart& start, const std::string& solver,
                 double inlier_probability);

  std::vector<WeighedLoop>& loops() { return loops_; }
  const std::vector<WeighedLoop>& loops() const { return loops_; }
  void setWeight(WeighedLoop& loop, double weight);
  /** Weighs all loops, or the graduated ones, by their squared residuals. \return true if no weight
   * changed. */
  bool weigh(const std::function<double(double)>& weight_of, bool graduated_only);
  /** The graduated loops that a predicate chooses. */
  template <class Which>
  std::vector<WeighedLoop*> graduated(Which which) {
    std::vector<WeighedLoop*> chosen;
    for (WeighedLoop& loop : loops_)
      if (loop.graduated && which(loop)) chosen.push_back(&loop);
    return chosen;
  }
  /** How many loops take part but disagree with the poses, or the reverse. */
  size_t inconsistent() const;

  void setPoses(const std::vector<Pose3>& poses) { problem_->setPoses(poses); }
  std::vector<Pose3> poses() const { return problem_->poses(); }
  /** \param full the tolerance with which a solve counts as complete. */
  void solve(const SolverOptions& options, double full);
  /** Whether the last solve was complete, with the weights as they are. */
  bool solved() const { return solved_; }
  /** The weighted cost after the last solve. */
  double cost() const { return last_.final_cost; }

  double residual2(const WeighedLoop& loop) const {
    return problem_->chi2(loop.edge) / loop.threshold;
  }
  size_t disagreeing() const;
  /** Of the graduated loops. */
  std::vector<double> residuals2() const;
  /** Of the graduated loops that take part. */
  std::vector<double> keptResiduals2() const;
  /** PoseProblem::leaveOneOut2(). */
  std::vector<double> distancesToOthers2(const std::vector<WeighedLoop*>& loops);

  /** The truncated cost of the current poses, with the verdicts that make it least. */
  double truncatedCost() const;
  /** The least truncated cost of all solves so far, and the poses that have it. */
  double bestCost() const { return best_cost_; }
  const std::vector<Pose3>& bestPoses() const { return best_poses_; }
  /** Whether the residuals of the last solve are larger than the stated covariances allow: there
   * are false loops, or this is not the global minimum. */
  bool fitsPoorly() const;

  /** Poses, verdicts and counts. */
  OptimizationResult result() const;

 private:
  const PoseGraph& graph_;
  const SolveStart& start_;
  std::unique_ptr<PoseProblem> problem_;
  std::vector<WeighedLoop> loops_;
  SolveSummary last_;
  bool solved_ = false;
  int solves_ = 0;
  int iterations_ = 0;
  double initial_cost_ = 0;
  double best_cost_ = std::numeric_limits<double>::infinity();
  std::vector<Pose3> best_poses_;
};

/** The largest value; 0 if there are none. */
double largest(const std::vector<double>& values);

}  // namespace lamp
