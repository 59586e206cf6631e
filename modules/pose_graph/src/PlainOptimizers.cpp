#include "lamp/pose_graph/PlainOptimizers.h"

#include "guess/SolveStart.h"
#include "lamp/pose_graph/InitialGuess.h"
#include "solver/PoseProblem.h"

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(PlainOptimizer, Optimizer, lamp)
IMPLEMENTS_MRPT_OBJECT(Lm, PlainOptimizer, lamp)
IMPLEMENTS_MRPT_OBJECT(Gn, PlainOptimizer, lamp)
IMPLEMENTS_MRPT_OBJECT(CeresLm, PlainOptimizer, lamp)

namespace lamp {

void SolverOptions::visit(OptionVisitor& v) {
  v("max_iterations", max_iterations, "", "maximum number of iterations per solve", kPositive);
  v("function_tolerance", function_tolerance, "",
    "a solve stops when an iteration lowers the cost by less than this fraction", kNotNegative);
}

namespace {

std::vector<Pose3> startOf(const std::string& start, const PoseGraph& graph,
                           const std::vector<bool>& admitted) {
  if (start == "odometry") return initialGuess(graph, admitted);
  if (start == "spanning_tree") return spanningTreeGuess(judged(graph, admitted));
  if (start == "chordal") return chordalGuess(judged(graph, admitted));
  std::vector<Pose3> estimates;
  for (const Node& node : graph.nodes()) estimates.push_back(node.world_T_base);
  return estimates;
}

}  // namespace

void PlainOptions::visit(OptionVisitor& v) {
  v("start", start, "where the solver starts",
    {"estimate", "odometry", "spanning_tree", "chordal"});
  solve.visit(v);
}

OptimizationResult PlainOptimizer::optimize(const PoseGraph& graph,
                                            const std::vector<bool>& admitted) {
  const SolveStart start = completeStart(graph, startOf(options_.start, graph, admitted), admitted);
  const std::unique_ptr<PoseProblem> problem = makePoseProblem(solver(), graph, start.poses);
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e)
    if (graph.edges()[e].mayBeRejected() && !start.admitted[e]) problem->setWeight(e, 0.0);
  const SolveSummary summary = problem->solve(options_.solve);

  OptimizationResult result;
  splitSolution(graph, start, problem->poses(), result);
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    if (!graph.edges()[e].mayBeRejected()) continue;
    const bool kept = start.admitted[e];
    result.loops.push_back(
        {e, kept ? Verdict::kInlier : Verdict::kOutlier, kept ? 1.0 : 0.0, problem->chi2(e)});
  }
  result.report.usable = summary.usable;
  result.report.termination = summary.termination;
  result.report.iterations = summary.iterations;
  result.report.initial_cost = summary.initial_cost;
  result.report.final_cost = summary.final_cost;
  return result;
}

}  // namespace lamp
