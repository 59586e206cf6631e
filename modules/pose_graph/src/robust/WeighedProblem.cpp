#include "robust/WeighedProblem.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lamp/core/ChiSquare.h"
#include "solver/Information.h"

namespace lamp {

namespace {

int rankOf(const PoseGraph& graph, EdgeIndex edge) {
  return std::max(1, informationRank(graph.edges()[edge].information, graph.planar()));
}

std::vector<WeighedLoop> weighedLoops(const PoseGraph& graph, const std::vector<bool>& admitted,
                                      double inlier_probability) {
  std::array<double, 7> thresholds{};
  for (int rank = 1; rank <= 6; ++rank)
    thresholds[rank] = chiSquareQuantile(inlier_probability, rank);
  std::vector<WeighedLoop> loops;
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e)
    if (graph.edges()[e].mayBeRejected() && admitted[e])
      loops.push_back({e, thresholds[rankOf(graph, e)]});
  return loops;
}

}  // namespace

double largest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

WeighedProblem::WeighedProblem(const PoseGraph& graph, const SolveStart& start,
                               const std::string& solver, double inlier_probability)
    : graph_(graph),
      start_(start),
      problem_(makePoseProblem(solver, graph, start.poses)),
      loops_(weighedLoops(graph, start.admitted, inlier_probability)) {
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e)
    if (!start.admitted[e] && graph.edges()[e].mayBeRejected()) problem_->setWeight(e, 0.0);
}

void WeighedProblem::setWeight(WeighedLoop& loop, double weight) {
  solved_ = solved_ && weight == loop.weight;
  loop.weight = weight;
  problem_->setWeight(loop.edge, weight);
}

bool WeighedProblem::weigh(const std::function<double(double)>& weight_of, bool graduated_only) {
  bool same = true;
  for (WeighedLoop& loop : loops_) {
    if (graduated_only && !loop.graduated) continue;
    const double weight = weight_of(residual2(loop));
    same = same && weight == loop.weight;
    setWeight(loop, weight);
  }
  return same;
}

size_t WeighedProblem::inconsistent() const {
  return static_cast<size_t>(std::count_if(
      loops_.begin(), loops_.end(),
      [&](const WeighedLoop& loop) { return (loop.weight > 0) != (residual2(loop) <= 1.0); }));
}

size_t WeighedProblem::disagreeing() const {
  return static_cast<size_t>(
      std::count_if(loops_.begin(), loops_.end(),
                    [&](const WeighedLoop& loop) { return residual2(loop) > 1.0; }));
}

void WeighedProblem::solve(const SolverOptions& options, double full) {
  last_ = problem_->solve(options);
  solved_ = options.function_tolerance <= full && last_.iterations < options.max_iterations;
  if (solves_ == 0) initial_cost_ = last_.initial_cost;
  iterations_ += last_.iterations;
  ++solves_;
  const double cost = truncatedCost();
  if (!last_.usable || !(cost < best_cost_)) return;
  best_cost_ = cost;
  best_poses_ = problem_->poses();
}

std::vector<double> WeighedProblem::residuals2() const {
  std::vector<double> result;
  for (const WeighedLoop& loop : loops_)
    if (loop.graduated) result.push_back(residual2(loop));
  return result;
}

std::vector<double> WeighedProblem::keptResiduals2() const {
  std::vector<double> result;
  for (const WeighedLoop& loop : loops_)
    if (loop.graduated && loop.weight > 0) result.push_back(residual2(loop));
  return result;
}

std::vector<double> WeighedProblem::distancesToOthers2(const std::vector<WeighedLoop*>& loops) {
  if (loops.empty()) return {};
  std::vector<EdgeIndex> edges;
  for (const WeighedLoop* loop : loops) edges.push_back(loop->edge);
  std::vector<double> distances2 = problem_->leaveOneOut2(edges);
  for (size_t i = 0; i < loops.size(); ++i) distances2[i] /= loops[i]->threshold;
  return distances2;
}

double WeighedProblem::truncatedCost() const {
  double sum = 0;
  auto loop = loops_.begin();
  for (EdgeIndex e = 0; e < graph_.edges().size(); ++e) {
    if (loop != loops_.end() && loop->edge == e)
      sum += std::min(1.0, residual2(*loop)) * loop->threshold, ++loop;
    else if (!graph_.edges()[e].mayBeRejected())
      sum += problem_->chi2(e);
  }
  return 0.5 * sum;
}

bool WeighedProblem::fitsPoorly() const {
  constexpr double kSigmas = 4.0;
  double redundancy = 0;  // odometry alone has none
  for (const WeighedLoop& loop : loops_)
    if (loop.weight > 0) redundancy += rankOf(graph_, loop.edge);
  return 2.0 * last_.final_cost > redundancy + kSigmas * std::sqrt(2.0 * redundancy);
}

OptimizationResult WeighedProblem::result() const {
  OptimizationResult result;
  splitSolution(graph_, start_, problem_->poses(), result);
  auto loop = loops_.begin();
  for (EdgeIndex e = 0; e < graph_.edges().size(); ++e) {
    if (!graph_.edges()[e].mayBeRejected()) continue;
    const bool mine = loop != loops_.end() && loop->edge == e;
    const double weight = mine ? (loop++)->weight : 0.0;
    result.loops.push_back(
        {e, weight > 0 ? Verdict::kInlier : Verdict::kOutlier, weight, problem_->chi2(e)});
  }
  result.report.usable = last_.usable;
  result.report.termination = last_.termination;
  result.report.iterations = iterations_;
  result.report.rounds = solves_;
  result.report.initial_cost = initial_cost_;
  result.report.final_cost = last_.final_cost;
  return result;
}

}  // namespace lamp
