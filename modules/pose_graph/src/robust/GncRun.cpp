#include "robust/GncRun.h"

#include <algorithm>
#include <limits>

#include "lamp/pose_graph/InitialGuess.h"
#include "robust/GemanMcClure.h"
#include "robust/GncMemory.h"
#include "robust/TruncatedLeastSquares.h"

namespace lamp {

namespace {

constexpr int kMaxTrims = 30;
constexpr double kTrimmedFactor = 4.0;
constexpr double kMaxTrimmed = 0.1;
constexpr int kMaxSettlingRounds = 20;
constexpr double kClearly = 1.0 - 1e-6;
/** All loops may agree with odometry even if they do not agree with their own solution. */
constexpr double kLeastStart = 2.0;
/** While weights still change by a factor in each round, the last digits do not matter. */
constexpr double kInnerTolerance = 1e-3;
constexpr double kUpdateTolerance = 1e-6;

const char* const kTruncated = "TruncatedLeastSquares";
const char* const kGemanMcClure = "GemanMcClure";

std::unique_ptr<Graduation> makeGraduation(const std::string& loss) {
  if (loss == kGemanMcClure) return std::make_unique<GemanMcClure>();
  return std::make_unique<TruncatedLeastSquares>();
}

SolveStart startOf(const PoseGraph& graph, const std::vector<bool>& admitted,
                   const GncMemory* memory) {
  std::vector<Pose3> guess = initialGuess(graph, admitted);
  if (memory) guess = continuedPoses(graph, *memory, guess);
  return completeStart(graph, std::move(guess), admitted);
}

/** Loops that were judged before keep their verdict until the last stage, which judges all. */
void keepVerdicts(const GncMemory& memory, WeighedProblem& problem) {
  for (WeighedLoop& loop : problem.loops()) {
    loop.graduated = loop.edge >= memory.edges.size() || !memory.admitted[loop.edge];
    if (!loop.graduated) problem.setWeight(loop, memory.inlier[loop.edge] ? 1.0 : 0.0);
  }
}

}  // namespace

std::vector<std::string> graduationNames() {
  return {kTruncated, kGemanMcClure};
}

GncRun::GncRun(const PoseGraph& graph, const std::vector<bool>& admitted, const GncOptions& options,
               const GncMemory* memory)
    : graph_(graph),
      options_(options),
      continued_(memory != nullptr),
      start_(startOf(graph, admitted, memory)),
      problem_(graph, start_, options.solver, options.inlier_probability),
      graduation_(makeGraduation(options.loss)),
      full_(options.final_solve) {
  // The next update continues where this one stops.
  if (memory) full_.function_tolerance = std::max(full_.function_tolerance, kUpdateTolerance);
  inner_ = first_ = full_;
  inner_.max_iterations = first_.max_iterations = options.inner_iterations;
  inner_.function_tolerance = std::max(inner_.function_tolerance, kInnerTolerance);
  if (memory) keepVerdicts(*memory, problem_);
}

OptimizationResult GncRun::run() {
  const std::vector<Pose3> by_odometry = start_.poses;
  if (!problem_.loops().empty()) {
    solveFromGuess(first_);
    if (!continued_ && !problem_.solved() && problem_.fitsPoorly()) tryChordalGuess();
  }
  if (largest(problem_.residuals2()) > 1.0) {
    const std::vector<Pose3> with_all = problem_.poses();
    if (!trim()) {
      problem_.setPoses(options_.gnc_bias_odom ? by_odometry : with_all);
      graduate();
    }
  }
  settle();
  if (problem_.bestCost() < kClearly * problem_.truncatedCost()) {
    // The run has seen a lower minimum than the one in which it has ended.
    problem_.setPoses(problem_.bestPoses());
    settle();
  }
  OptimizationResult result = problem_.result();
  result.report.termination = "GNC: " + stopping_ + "; last solve: " + result.report.termination;
  return result;
}

/** Odometry may lead into a wrong minimum. A chordal initialisation does not need good odometry,
 * but loops can mislead it: it becomes the guess if its solution has the lower truncated cost. */
void GncRun::tryChordalGuess() {
  const double cost = problem_.truncatedCost();
  const std::vector<Pose3> poses = problem_.poses();
  const std::vector<Pose3> chordal = chordalGuess(judged(graph_, start_.admitted));
  std::vector<Pose3> guess = completeStart(graph_, chordal, start_.admitted).poses;
  problem_.setPoses(guess);
  solve(first_);
  if (problem_.truncatedCost() < cost)
    start_.poses = std::move(guess);
  else
    problem_.setPoses(poses);
}

/** Takes out the worst loops until the others agree. Each solve starts at the guess, since from the
 * shape that false loops gave it the graph recovers only slowly. Gives up when this no longer
 * helps.
 * \return whether so few had to go that no other set of loops that agree can be as large. */
bool GncRun::trim() {
  stopping_ = "all but a few loops agree";
  const auto kept = [](double residual2) {
    return [=](double r2) { return r2 <= std::max(1.0, residual2 / kTrimmedFactor) ? 1.0 : 0.0; };
  };
  const size_t loops = problem_.loops().size();
  double before = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kMaxTrims && 2 * problem_.disagreeing() <= loops; ++round) {
    const double worst = largest(problem_.keptResiduals2());
    if (worst <= 1.0) return true;
    if (worst >= before) break;
    before = worst;
    problem_.weigh(kept(worst), true);
    if (trimmedShare() > kMaxTrimmed) break;
    solveFromGuess(inner_);
  }
  for (WeighedLoop* loop : problem_.graduated([](const WeighedLoop&) { return true; }))
    problem_.setWeight(*loop, 1.0);
  return false;
}

/** The share of loops taken out, among those that take part or could. */
double GncRun::trimmedShare() const {
  double out = 0, all = 0;
  for (const WeighedLoop& loop : problem_.loops()) {
    out += loop.graduated && loop.weight == 0.0;
    all += loop.graduated || loop.weight > 0.0;
  }
  return out / all;
}

/** Each round continues from the last solution. If that fits poorly, as true loops with their
 * weights would not, it may be a wrong minimum, and the guess is tried as well. */
void GncRun::graduate() {
  constexpr int kSureRounds = 2;
  stopping_ = "max_rounds reached";
  graduation_->start(std::max(largest(problem_.residuals2()), kLeastStart));
  int sure = 0;
  for (int round = 1; round < options_.max_rounds; ++round) {
    const bool same =
        problem_.weigh([&](double residual2) { return graduation_->weight(residual2); }, true);
    if ((same && graduation_->exactFor(problem_.residuals2())) || sure >= kSureRounds) {
      stopping_ = "no loop left in doubt";
      return;
    }
    if (graduation_->sharp()) {
      stopping_ = "few loops left in doubt";
      return;
    }
    solveFromBothStarts();
    sure = problem_.inconsistent() == 0 ? sure + 1 : 0;
    graduation_->sharpen(options_.mu_step);
  }
}

void GncRun::solveFromBothStarts() {
  solve(inner_);
  if (!problem_.fitsPoorly()) return;
  const double cost = problem_.cost();
  const std::vector<Pose3> poses = problem_.poses();
  solveFromGuess(inner_);
  if (!(problem_.cost() < cost)) problem_.setPoses(poses);
}

/** Alternates between solving and judging at the threshold, neither of which can raise the
 * truncated cost. Once loops have been left out, it starts over from the guess. Solves are cut
 * short until no verdict changes: with a false loop still in, they hardly converge. */
void GncRun::settle() {
  const auto verdict = [](double residual2) { return residual2 <= 1.0 ? 1.0 : 0.0; };
  problem_.weigh(verdict, false);
  bool full = false;
  for (int round = 0; round < kMaxSettlingRounds; ++round) {
    if (!problem_.solved()) solve(full ? full_ : first_);
    const bool same = problem_.weigh(verdict, false);
    if (same && rejectByLeavingOut()) {
      solveFromGuess(first_);
      continue;
    }
    if (same && admitByTakingIn()) {
      solve(first_);
      continue;
    }
    if (same && (full || problem_.solved())) return;
    full = same;
  }
  stopping_ += ", but the last verdicts still changed";
}

/** Takes out loops without which the truncated cost is lower: others have given way to them. If
 * there are several, only the worst go, since they make others look bad.
 * \return whether there are any. */
bool GncRun::rejectByLeavingOut() {
  const std::vector<WeighedLoop*> judged =
      problem_.graduated([](const WeighedLoop& l) { return l.weight > 0; });
  const std::vector<double> distances2 = problem_.distancesToOthers2(judged);
  const double worst = largest(distances2);
  if (!(worst > 1.0)) return false;
  for (size_t i = 0; i < judged.size(); ++i) {
    if (!(distances2[i] > std::max(1.0, worst / kTrimmedFactor))) continue;
    problem_.setWeight(*judged[i], 0.0);
    judged[i]->left_out = true;
  }
  return true;
}

/** The reverse: takes in loops that do not agree with the solution, but would if it gave way to
 * them as far as its covariance allows. Each comes in once: the next verdict tells whether the
 * solution did give way.
 * \return whether there are any. */
bool GncRun::admitByTakingIn() {
  const std::vector<WeighedLoop*> judged = problem_.graduated([&](const WeighedLoop& l) {
    return l.weight == 0 && !l.left_out && !l.taken_in && graph_.edges()[l.edge].isLoopClosure();
  });
  const std::vector<double> distances2 = problem_.distancesToOthers2(judged);
  bool any = false;
  for (size_t i = 0; i < judged.size(); ++i) {
    if (!(distances2[i] <= 1.0)) continue;
    problem_.setWeight(*judged[i], 1.0);
    judged[i]->taken_in = true;
    any = true;
  }
  return any;
}

void GncRun::solveFromGuess(const SolverOptions& options) {
  problem_.setPoses(start_.poses);
  solve(options);
}

}  // namespace lamp
