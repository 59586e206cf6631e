#include "lamp/pose_graph/Gnc.h"

#include "robust/GncMemory.h"
#include "robust/GncRun.h"

IMPLEMENTS_MRPT_OBJECT(Gnc, Optimizer, lamp)

namespace lamp {

namespace {

/** Share of the inliers that updates may reject before all loops are weighed anew. */
constexpr double kMaxDoubt = 0.1;

}  // namespace

void GncOptions::visit(OptionVisitor& v) {
  v("solver", solver, "least-squares solver of each round", solverNames());
  v("loss", loss, "robust cost function", graduationNames());
  v("inlier_probability", inlier_probability, "",
    "probability that a true loop closure's squared residual is below the threshold",
    {0.0, 1.0 - 1e-12});
  v("mu_step", mu_step, "", "factor by which the control parameter mu changes per round", {1.01});
  v("max_rounds", max_rounds, "", "maximum number of rounds", kPositive);
  v("inner_iterations", inner_iterations, "", "maximum number of iterations in each round",
    kPositive);
  v("gnc_bias_odom", gnc_bias_odom,
    "if loop closures contradict one another, weight them first by odometry alone instead of by "
    "the solution distorted by all of them");
  v("incremental", incremental,
    "when the graph has grown, start from the last solution and verdicts and graduate only the new "
    "loop closures");
  final_solve.visit(v);
}

OptimizationResult Gnc::optimize(const PoseGraph& graph, const std::vector<bool>& admitted) {
  const bool update = options_.incremental && !memory_.nodes.empty() && continues(graph, memory_);
  OptimizationResult result = GncRun(graph, admitted, options_, update ? &memory_ : nullptr).run();
  size_t doubtful = 0;
  if (update) {
    size_t inliers = 0;
    doubtful = memory_.doubtful_loops;
    for (const LoopVerdict& loop : result.loops) {
      const bool inlier = loop.verdict == Verdict::kInlier;
      inliers += inlier;
      doubtful += !inlier && admitted[loop.edge] && loop.edge >= memory_.edges.size();
    }
    if (static_cast<double>(doubtful) > kMaxDoubt * static_cast<double>(inliers)) {
      result = GncRun(graph, admitted, options_, nullptr).run();
      doubtful = 0;
    }
  }
  if (result.report.usable && options_.incremental) {
    memory_ = remember(graph, admitted, result);
    memory_.doubtful_loops = doubtful;
  }
  return result;
}

}  // namespace lamp
