#include "lamp/pose_graph/PlainOptimizers.h"

#include "PoseProblem.h"
#include "SolveStart.h"
#include "lamp/pose_graph/InitialGuess.h"

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(PlainOptimizer, Optimizer, lamp)
IMPLEMENTS_MRPT_OBJECT(Lm, PlainOptimizer, lamp)
IMPLEMENTS_MRPT_OBJECT(Gn, PlainOptimizer, lamp)
IMPLEMENTS_MRPT_OBJECT(CeresLm, PlainOptimizer, lamp)

namespace lamp {

void SolverOptions::visit(OptionVisitor& v) {
  v("max_iterations", max_iterations, "", "most iterations of a solve", kPositive);
  v("function_tolerance", function_tolerance, "",
    "a solve stops when an iteration lowers the cost by less than this share", kNotNegative);
}

namespace {

std::vector<Pose3> startOf(const std::string& start, const PoseGraph& graph,
                           const std::vector<bool>& admitted) {
  if (start == "odometry") return initialGuess(graph, admitted);
  if (start == "spanning_tree") return spanningTreeGuess(graph);
  if (start == "chordal") return chordalGuess(graph);
  std::vector<Pose3> estimates;
  for (const Node& node : graph.nodes()) estimates.push_back(node.world_T_base);
  return estimates;
}

/** Verdicts as the flags say. */
PoseGraph judged(PoseGraph graph, const std::vector<bool>& admitted) {
  for (EdgeIndex e = 0; e < admitted.size(); ++e) {
    Edge& edge = graph.edges()[e];
    if (edge.mayBeRejected()) edge.verdict = admitted[e] ? Verdict::kInlier : Verdict::kOutlier;
  }
  return graph;
}

}  // namespace

void PlainOptions::visit(OptionVisitor& v) {
  v("start", start, "where the solver starts",
    {"estimate", "odometry", "spanning_tree", "chordal"});
  solve.visit(v);
}

OptimizationResult PlainOptimizer::optimize(const PoseGraph& unjudged,
                                            const std::vector<bool>& admitted) {
  // A start in which some loops take part must not take those that do not.
  const std::vector<Pose3> from = startOf(options_.start, judged(unjudged, admitted), admitted);
  const SolveStart start = completeStart(unjudged, from, admitted);
  const PoseGraph graph = judged(unjudged, start.admitted);
  const std::unique_ptr<PoseProblem> problem = makePoseProblem(solver(), graph, start.poses);
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e)
    if (!graph.edges()[e].active()) problem->setWeight(e, 0.0);
  const SolveSummary summary = problem->solve(options_.solve);

  OptimizationResult result;
  splitSolution(graph, start, problem->poses(), result);
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (!edge.mayBeRejected()) continue;
    result.loops.push_back({e, edge.active() ? Verdict::kInlier : Verdict::kOutlier,
                            edge.active() ? 1.0 : 0.0, problem->chi2(e)});
  }
  result.report = {
      summary.usable,
      summary.termination,
      summary.iterations,
      1,
      summary.initial_cost,
      summary.final_cost,
      {},
  };
  return result;
}

}  // namespace lamp
