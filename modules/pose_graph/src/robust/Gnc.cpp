#include "lamp/pose_graph/Gnc.h"

#include <algorithm>
#include <array>
#include <limits>

#include "guess/SolveStart.h"
#include "lamp/core/ChiSquare.h"
#include "lamp/pose_graph/InitialGuess.h"
#include "robust/GemanMcClure.h"
#include "robust/GncMemory.h"
#include "robust/TruncatedLeastSquares.h"
#include "solver/Information.h"
#include "solver/PoseProblem.h"

IMPLEMENTS_MRPT_OBJECT(Gnc, Optimizer, lamp)

namespace lamp {

namespace {

/** Share of the inliers that updates may reject before all loops are weighed anew. */
constexpr double kMaxDoubt = 0.1;

const char* const kTruncated = "TruncatedLeastSquares";
const char* const kGemanMcClure = "GemanMcClure";

std::unique_ptr<Graduation> makeGraduation(const std::string& loss) {
  if (loss == kGemanMcClure) return std::make_unique<GemanMcClure>();
  return std::make_unique<TruncatedLeastSquares>();
}

/** A loop closure, or other edge that may be rejected. */
struct GncLoop {
  EdgeIndex edge;
  double threshold;  ///< the largest squared residual of an inlier
  double weight = 1.0;
  bool graduated = true;  ///< else it keeps its weight until the last stage
  bool left_out = false;  ///< the truncated cost was lower without it
};

std::vector<GncLoop> gncLoops(const PoseGraph& graph, const std::vector<bool>& admitted,
                              double inlier_probability) {
  std::array<double, 7> thresholds{};
  for (int rank = 1; rank <= 6; ++rank)
    thresholds[rank] = chiSquareQuantile(inlier_probability, rank);
  std::vector<GncLoop> loops;
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (!edge.mayBeRejected() || !admitted[e]) continue;
    const int rank = std::max(1, informationRank(edge.information, graph.planar()));
    loops.push_back({e, thresholds[rank]});
  }
  return loops;
}

/** Loops that were judged before keep their verdict until the last stage, which judges all. */
void keepVerdicts(const GncMemory& memory, std::vector<GncLoop>& loops) {
  for (GncLoop& loop : loops) {
    loop.graduated = loop.edge >= memory.edges.size() || !memory.admitted[loop.edge];
    if (!loop.graduated) loop.weight = memory.inlier[loop.edge] ? 1.0 : 0.0;
  }
}

/** One run of the algorithm over one graph. */
class GncRun {
 public:
  /** \param memory of the graph that this one continues, or null. */
  GncRun(const PoseGraph& graph, const std::vector<bool>& admitted, const GncOptions& options,
         const GncMemory* memory)
      : graph_(graph),
        options_(options),
        start_(completeStart(graph,
                             memory ? continuedPoses(graph, *memory, initialGuess(graph, admitted))
                                    : initialGuess(graph, admitted),
                             admitted)),
        problem_(makePoseProblem(options.solver, graph, start_.poses)),
        graduation_(makeGraduation(options.loss)),
        loops_(gncLoops(graph, start_.admitted, options.inlier_probability)),
        full_(options.final_solve) {
    // The next update goes on where this one stops.
    if (memory) full_.function_tolerance = std::max(full_.function_tolerance, kUpdateTolerance);
    inner_ = first_ = full_;
    inner_.max_iterations = first_.max_iterations = options.inner_iterations;
    inner_.function_tolerance = std::max(inner_.function_tolerance, kInnerTolerance);
    if (memory) keepVerdicts(*memory, loops_);
    for (EdgeIndex e = 0; e < graph.edges().size(); ++e)
      if (!start_.admitted[e] && graph.edges()[e].mayBeRejected()) problem_->setWeight(e, 0.0);
    for (const GncLoop& loop : loops_) problem_->setWeight(loop.edge, loop.weight);
  }

  OptimizationResult run() {
    if (!loops_.empty()) solveFromGuess(first_);
    if (largest(residuals2()) > 1.0 && !trim() && !solveWithAll()) {
      if (options_.gnc_bias_odom) problem_->setPoses(start_.poses);
      graduation_->start(std::max(largest(residuals2()), kLeastStart));
      graduate();
    }
    settle();
    if (best_cost_ < kClearly * truncatedCost()) settleFromBest();
    return result();
  }

 private:
  /** A graph without false loops may be far from the guess: goes on while each solve halves the
   * loops that disagree. With false ones there is hardly an end to it. \return whether all agree.
   */
  bool solveWithAll() {
    stopping_ = "all loops agree";
    solveFromGuess(first_);
    size_t before = loops_.size(), now = disagreeing();
    while (!solved_ && now > 0 && now <= before / 2) {
      before = now;
      solve(first_);
      now = disagreeing();
    }
    return now == 0;
  }

  size_t disagreeing() const {
    return static_cast<size_t>(std::count_if(loops_.begin(), loops_.end(),
                                             [&](const GncLoop& l) { return residual2(l) > 1.0; }));
  }

  /** Takes the worst loops out until the others agree. Each solve starts anew: out of the shape
   * that false loops gave it, the graph finds its way back slowly.
   * \return whether so few had to go that no other set of loops can be as large. */
  bool trim() {
    stopping_ = "all but a few loops agree";
    const auto kept = [](double residual2) {
      return [=](double r2) { return r2 <= std::max(1.0, residual2 / kTrimmedFactor) ? 1.0 : 0.0; };
    };
    for (int round = 0; round < kMaxTrims; ++round) {
      const double worst = largest(keptResiduals2());
      if (worst <= 1.0) return true;
      weigh(kept(worst), true);
      if (trimmedShare() > kMaxTrimmed) break;
      solveFromGuess(inner_);
    }
    for (GncLoop& loop : loops_)
      if (loop.graduated) setWeight(loop, 1.0);
    return false;
  }

  void graduate() {
    stopping_ = "max_rounds reached";
    for (int round = 1; round < options_.max_rounds; ++round) {
      const bool same =
          weigh([&](double residual2) { return graduation_->weight(residual2); }, true);
      if (same && graduation_->exactFor(residuals2())) {
        stopping_ = "no loop left in doubt";
        return;
      }
      if (graduation_->sharp()) {
        stopping_ = "few loops left in doubt";
        return;
      }
      solveFromGuess(inner_);
      graduation_->sharpen(options_.mu_step);
    }
  }

  /** Solves and verdicts at the threshold in turn, of which neither can raise the truncated cost;
   * anew where loops were left out. Solves are short until no verdict changes: with a false loop
   * still in, there is hardly an end to them. */
  void settle() {
    const auto verdict = [](double residual2) { return residual2 <= 1.0 ? 1.0 : 0.0; };
    weigh(verdict, false);
    bool full = false;
    for (int round = 0; round < kMaxSettlingRounds; ++round) {
      if (!solved_) solve(full ? full_ : first_);
      const bool same = weigh(verdict, false);
      if (same && rejectByLeavingOut()) {
        solveFromGuess(first_);
        continue;
      }
      if (same && admitByTakingIn()) {
        solve(first_);
        continue;
      }
      if (same && (full || solved_)) return;
      full = same;
    }
    stopping_ += ", but the last verdicts still changed";
  }

  /** Takes out loops without which the truncated cost is lower: to these others have given way. If
   * there are several, the worst ones, since those make others look bad. \return whether any is. */
  bool rejectByLeavingOut() {
    const std::vector<GncLoop*> judged =
        graduatedLoops([](const GncLoop& l) { return l.weight > 0; });
    const std::vector<double> distances2 = distancesToOthers2(judged);
    const double worst = largest(distances2);
    if (!(worst > 1.0)) return false;
    for (size_t i = 0; i < judged.size(); ++i) {
      if (!(distances2[i] > std::max(1.0, worst / kTrimmedFactor))) continue;
      setWeight(*judged[i], 0.0);
      judged[i]->left_out = true;
    }
    return true;
  }

  /** The reverse: takes in loops that do not agree with the solution, but would if it gave way to
   * them as far as its covariance allows. \return whether any is. */
  bool admitByTakingIn() {
    const std::vector<GncLoop*> judged = graduatedLoops([&](const GncLoop& l) {
      return l.weight == 0 && !l.left_out && graph_.edges()[l.edge].isLoopClosure();
    });
    const std::vector<double> distances2 = distancesToOthers2(judged);
    bool any = false;
    for (size_t i = 0; i < judged.size(); ++i) {
      if (!(distances2[i] <= 1.0)) continue;
      setWeight(*judged[i], 1.0);
      any = true;
    }
    return any;
  }

  template <class Which>
  std::vector<GncLoop*> graduatedLoops(Which which) {
    std::vector<GncLoop*> chosen;
    for (GncLoop& loop : loops_)
      if (loop.graduated && which(loop)) chosen.push_back(&loop);
    return chosen;
  }

  /** In units of the thresholds. */
  std::vector<double> distancesToOthers2(const std::vector<GncLoop*>& loops) {
    if (loops.empty()) return {};
    std::vector<EdgeIndex> edges;
    for (const GncLoop* loop : loops) edges.push_back(loop->edge);
    std::vector<double> distances2 = problem_->leaveOneOut2(edges);
    for (size_t i = 0; i < loops.size(); ++i) distances2[i] /= loops[i]->threshold;
    return distances2;
  }

  /** Of the poses as they are, with the verdicts that make it least. */
  double truncatedCost() const {
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

  /** Another minimum that the run has seen is lower than the one in which it has ended. */
  void settleFromBest() {
    problem_->setPoses(best_poses_);
    settle();
  }

  void solveFromGuess(const SolverOptions& options) {
    problem_->setPoses(start_.poses);
    solve(options);
  }

  void solve(const SolverOptions& options) {
    last_ = problem_->solve(options);
    solved_ = options.function_tolerance <= full_.function_tolerance &&
              last_.iterations < options.max_iterations;
    if (rounds_ == 0) initial_cost_ = last_.initial_cost;
    iterations_ += last_.iterations;
    ++rounds_;
    const double cost = truncatedCost();
    if (!last_.usable || !(cost < best_cost_)) return;
    best_cost_ = cost;
    best_poses_ = problem_->poses();
  }

  /** Weighs all loops, or the graduated ones, by their residuals. \return true if no weight
   * changed. */
  template <class Weight>
  bool weigh(Weight weight_of, bool graduated_only) {
    bool same = true;
    for (GncLoop& loop : loops_) {
      if (graduated_only && !loop.graduated) continue;
      const double weight = weight_of(residual2(loop));
      same = same && weight == loop.weight;
      setWeight(loop, weight);
    }
    return same;
  }

  void setWeight(GncLoop& loop, double weight) {
    solved_ = solved_ && weight == loop.weight;
    loop.weight = weight;
    problem_->setWeight(loop.edge, weight);
  }

  /** Of the loops that take part or could, the share of those that were taken out. */
  double trimmedShare() const {
    double out = 0, all = 0;
    for (const GncLoop& loop : loops_) {
      out += loop.graduated && loop.weight == 0.0;
      all += loop.graduated || loop.weight > 0.0;
    }
    return out / all;
  }

  double residual2(const GncLoop& loop) const { return problem_->chi2(loop.edge) / loop.threshold; }

  /** Of the graduated loops. */
  std::vector<double> residuals2() const {
    std::vector<double> result;
    for (const GncLoop& loop : loops_)
      if (loop.graduated) result.push_back(residual2(loop));
    return result;
  }

  /** Of the graduated loops that take part. */
  std::vector<double> keptResiduals2() const {
    std::vector<double> result;
    for (const GncLoop& loop : loops_)
      if (loop.graduated && loop.weight > 0) result.push_back(residual2(loop));
    return result;
  }

  static double largest(const std::vector<double>& values) {
    return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
  }

  OptimizationResult result() const {
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
    result.report.termination = "GNC: " + stopping_ + "; last solve: " + last_.termination;
    result.report.iterations = iterations_;
    result.report.rounds = rounds_;
    result.report.initial_cost = initial_cost_;
    result.report.final_cost = last_.final_cost;
    return result;
  }

  static constexpr int kMaxTrims = 30;
  static constexpr double kTrimmedFactor = 4.0;
  static constexpr double kMaxTrimmed = 0.1;
  static constexpr int kMaxSettlingRounds = 20;
  static constexpr double kClearly = 1.0 - 1e-6;
  /** Odometry alone may agree with all loops where their solution does not. */
  static constexpr double kLeastStart = 2.0;
  /** Weights that change by a factor in each round do not need the last digits. */
  static constexpr double kInnerTolerance = 1e-3;
  static constexpr double kUpdateTolerance = 1e-6;

  const PoseGraph& graph_;
  const GncOptions& options_;
  const SolveStart start_;
  std::unique_ptr<PoseProblem> problem_;
  std::unique_ptr<Graduation> graduation_;
  std::vector<GncLoop> loops_;
  SolverOptions full_;
  SolverOptions inner_;  ///< of solves after which weights change
  SolverOptions first_;  ///< of the first, after which they may not
  std::string stopping_ = "all loops agree";
  SolveSummary last_;
  bool solved_ = false;  ///< to the end, with the weights as they are
  int rounds_ = 0;
  int iterations_ = 0;
  double initial_cost_ = 0;
  double best_cost_ = std::numeric_limits<double>::infinity();  ///< the least truncated cost seen
  std::vector<Pose3> best_poses_;
};

}  // namespace

void GncOptions::visit(OptionVisitor& v) {
  v("solver", solver, "least-squares solver of each round", solverNames());
  v("loss", loss, "robust cost function", {kTruncated, kGemanMcClure});
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
