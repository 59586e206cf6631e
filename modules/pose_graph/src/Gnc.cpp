#include "lamp/pose_graph/Gnc.h"

#include <algorithm>

#include "PoseProblem.h"
#include "TruncatedLeastSquares.h"
#include "lamp/core/ChiSquare.h"
#include "lamp/pose_graph/InitialGuess.h"

IMPLEMENTS_MRPT_OBJECT(Gnc, Optimizer, lamp)

namespace lamp {

namespace {

/** One run of the algorithm over one graph. */
class GncRun {
 public:
  GncRun(const PoseGraph& graph, const GncOptions& options)
      : graph_(graph),
        options_(options),
        guess_(initialGuess(graph)),
        problem_(makePoseProblem(options.solver, graph, guess_)),
        tls_{chiSquareQuantile(options.inlier_probability, graph.planar() ? 3 : 6)} {
    for (EdgeIndex e = 0; e < graph.edges().size(); ++e)
      if (graph.edges()[e].mayBeRejected()) loops_.push_back(e);
    weights_.assign(loops_.size(), 1.0);
    inner_ = options.final_solve;
    inner_.max_iterations = options.inner_iterations;
  }

  OptimizationResult run() {
    if (!loops_.empty()) solveFromGuess();
    if (maxChi2() > tls_.c2) graduate();
    settle();
    return result();
  }

 private:
  /** Rounds of growing mu, until no residual is left between sure inliers and sure outliers. */
  void graduate() {
    double mu = tls_.initialMu(maxChi2());
    for (int round = 1; round < options_.max_rounds; ++round, mu *= options_.mu_step) {
      const bool same = weigh([&](double chi2) { return tls_.weight(chi2, mu); });
      if (same && noneInTransition(mu)) return;
      solveFromGuess();
    }
  }

  /** Full solves and verdicts at the threshold in turn: neither can raise the truncated cost. */
  void settle() {
    const auto verdict = [&](double chi2) { return chi2 <= tls_.c2 ? 1.0 : 0.0; };
    weigh(verdict);
    for (int round = 0; round < kMostSettlingRounds; ++round) {
      note(problem_->solve(options_.final_solve));
      if (weigh(verdict)) return;
    }
  }

  void solveFromGuess() {
    problem_->setPoses(guess_);
    note(problem_->solve(inner_));
  }

  void note(const SolveSummary& summary) {
    last_ = summary;
    if (rounds_ == 0) initial_cost_ = summary.initial_cost;
    iterations_ += summary.iterations;
    ++rounds_;
  }

  /** Weighs the loops by their residuals. \return true if no weight changed. */
  template <class Weight>
  bool weigh(Weight weight_of) {
    bool same = true;
    for (size_t i = 0; i < loops_.size(); ++i) {
      const double weight = weight_of(problem_->chi2(loops_[i]));
      same = same && weight == weights_[i];
      weights_[i] = weight;
      problem_->setWeight(loops_[i], weight);
    }
    return same;
  }

  bool noneInTransition(double mu) const {
    return std::none_of(loops_.begin(), loops_.end(), [&](EdgeIndex loop) {
      const double chi2 = problem_->chi2(loop);
      return chi2 > tls_.inlierLimit(mu) && chi2 < tls_.outlierLimit(mu);
    });
  }

  double maxChi2() const {
    double largest = 0;
    for (const EdgeIndex loop : loops_) largest = std::max(largest, problem_->chi2(loop));
    return largest;
  }

  OptimizationResult result() const {
    OptimizationResult result;
    result.world_T_base = problem_->poses();
    for (size_t i = 0; i < loops_.size(); ++i)
      result.loops.push_back({loops_[i], weights_[i] > 0 ? Verdict::kInlier : Verdict::kOutlier,
                              weights_[i], problem_->chi2(loops_[i])});
    result.report = {last_.usable, last_.termination, iterations_,
                     rounds_,      initial_cost_,     last_.final_cost};
    return result;
  }

  static constexpr int kMostSettlingRounds = 20;

  const PoseGraph& graph_;
  const GncOptions& options_;
  const std::vector<Pose3> guess_;
  std::unique_ptr<PoseProblem> problem_;
  TruncatedLeastSquares tls_;
  SolverOptions inner_;
  std::vector<EdgeIndex> loops_;
  std::vector<double> weights_;  ///< of the loops
  SolveSummary last_;
  int rounds_ = 0;
  int iterations_ = 0;
  double initial_cost_ = 0;
};

}  // namespace

void GncOptions::visit(OptionVisitor& v) {
  v("solver", solver, "least-squares solver of each round", solverNames());
  v("inlier_probability", inlier_probability, "",
    "share of true loop closures whose squared residual is to stay below the threshold",
    {0.0, 1.0 - 1e-12});
  v("mu_step", mu_step, "", "factor by which the control parameter mu grows from round to round",
    {1.01});
  v("max_rounds", max_rounds, "", "most rounds of graduation", kPositive);
  v("inner_iterations", inner_iterations, "", "most iterations of the solve in each round",
    kPositive);
  final_solve.visit(v);
}

OptimizationResult Gnc::optimize(const PoseGraph& graph) {
  return GncRun(graph, options_).run();
}

}  // namespace lamp
