#include "TrimmedLm.h"

#include <lamp/core/ChiSquare.h>

IMPLEMENTS_MRPT_OBJECT(TrimmedLm, lamp::Optimizer, lamp)

namespace lamp {

void TrimmedLmOptions::visit(OptionVisitor& v) {
  v("inlier_probability", inlier_probability, "", "of a true loop closure, to be kept",
    {0, 0.9999999});
  v("max_rounds", max_rounds, "", "solves at most", {1});
}

void TrimmedLm::visit(OptionVisitor& v) {
  options_.visit(v);
  solver_.visit(v);
}

OptimizationResult TrimmedLm::optimize(const PoseGraph& graph, const std::vector<bool>& admitted) {
  const double max_chi2 = chiSquareQuantile(options_.inlier_probability, graph.planar() ? 3 : 6);
  std::vector<bool> kept = admitted;
  for (int round = 1;; ++round) {
    OptimizationResult result = solver_.optimize(graph, kept);
    std::vector<bool> fitting = admitted;
    for (const LoopVerdict& loop : result.loops)
      if (loop.chi2 > max_chi2) fitting[loop.edge] = false;
    if (fitting == kept || round == options_.max_rounds || !result.report.usable) {
      result.report.rounds = round;
      result.report.termination = "trimmed in " + std::to_string(round) +
                                  " rounds; the last solve: " + result.report.termination;
      return result;
    }
    kept = fitting;
  }
}

}  // namespace lamp
