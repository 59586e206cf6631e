#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lamp/pose_graph/Gnc.h"
#include "robust/Graduation.h"
#include "robust/WeighedProblem.h"

namespace lamp {

/** One run of Gnc over one graph. */
class GncRun {
 public:
  /** \param memory of the graph that this one continues, or null. All arguments must outlive
   * this. */
  GncRun(const PoseGraph& graph, const std::vector<bool>& admitted, const GncOptions& options,
         const GncMemory* memory);

  OptimizationResult run();

 private:
  void tryChordalGuess();
  bool trim();
  void graduate();
  void settle();
  bool rejectByLeavingOut();
  bool admitByTakingIn();
  double trimmedShare() const;
  void solveFromGuess(const SolverOptions& options);
  void solveFromBothStarts();
  void solve(const SolverOptions& options) { problem_.solve(options, full_.function_tolerance); }

  const PoseGraph& graph_;
  const GncOptions& options_;
  const bool continued_;
  SolveStart start_;
  WeighedProblem problem_;
  std::unique_ptr<Graduation> graduation_;
  SolverOptions full_;
  SolverOptions inner_;  ///< for solves after which weights change
  SolverOptions first_;  ///< for those after which they may not
  std::string stopping_ = "all loops agree";
};

/** Names for GncOptions::loss. */
std::vector<std::string> graduationNames();

}  // namespace lamp
