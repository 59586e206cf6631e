#include "lamp/base_station/BaseStation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "lamp/base_station/NodeRegistration.h"
#include "lamp/pose_graph/MarginalCovariances.h"
#include "lamp/registration/GraphGuess.h"

namespace lamp {

namespace {

using mrpt::system::CTimeLoggerEntry;

}  // namespace

BaseStation::BaseStation(BaseStationSetup setup, mrpt::system::CTimeLogger& timer)
    : COutputLogger("base_station"),
      options_(setup.options),
      inter_robot_loops_(setup.inter_robot_loops),
      generators_(std::move(setup.candidates)),
      priority_(std::move(setup.priority)),
      computation_(std::move(setup.computation)),
      back_end_(std::move(setup.back_end)),
      refinement_options_(setup.refinement),
      timer_(timer),
      scans_(setup.preparation),
      extra_edges_(std::move(setup.extra_edges)),
      placements_(computation_, scans_) {}

void BaseStation::receive(const KeyNodePacket& packet, const std::atomic<bool>& interrupted) {
  registerNode(packet, graph_);
  scans_.add(packet);
  tracks_.add(packet);
  if (packet.prior) robotsThatMet();  // by their start poses: nothing was missed
  for (const auto& generator : generators_) generator->add(packet);
  if (extra_edges_.add(packet.id, packet.extras, tracks_.packets(), graph_)) optimized_all_ = false;
  propose(packet.id);
  computeRound(static_cast<size_t>(options_.closures_per_round), interrupted);
  if (optimizationDue() && !interrupted) optimize();
}

void BaseStation::receive(const RobotEnd& end) {
  tracks_.add(end);
  const auto& nodes = graph_.robotNodes(end.robot);
  if (nodes.empty()) return;
  if (extra_edges_.add(nodes.back(), end.extras, tracks_.packets(), graph_)) optimized_all_ = false;
  for (const auto& generator : generators_) generator->end(end.robot);
  propose(nodes.back());
}

std::string BaseStation::apply(const OperatorAction& action, const RobotTable& robots) {
  const std::string outcome = operator_.apply(action, round_, robots, graph_, ledger_);
  actions_.push_back({action, outcome});
  if (outcome != "done") return outcome;
  if (action.kind == ActionKind::kReset) back_end_.optimizer->forget();
  if (action.kind == ActionKind::kRevive || action.kind == ActionKind::kReset)
    for (const Node& node : graph_.nodes()) propose(node.id);
  optimize();
  return outcome;
}

void BaseStation::finish(const std::atomic<bool>& interrupted) {
  if (placements_.askForLastAnswers(graph_)) optimized_all_ = false;
  // Each optimisation can bring key nodes together that were too far apart before.
  do {
    if (!interrupted) computeRound(0, interrupted);
    if (!optimized_all_ && !operator_.frozen()) optimize();
  } while (queue_.size() > 0 && !interrupted);
}

void BaseStation::refine(const std::function<bool(double share)>& go_on) {
  if (operator_.frozen() || generators_.empty()) return;
  const CTimeLoggerEntry timing(timer_, "refinement");
  std::vector<KeyedScanPtr> scans;
  for (const Node& node : graph_.nodes()) scans.push_back(tracks_.packets().at(node.id).scan);
  PoseGraph graph = graph_;
  for (Edge& edge : graph.edges())
    if (edge.type == EdgeType::kOdometry)
      edge.information /= report_.odometry_scale * report_.odometry_scale;
  const JointAdjustmentResult result = adjustJointly(graph, scans, refinement_options_, go_on);
  refinement_ = result.report;
  if (!refinement_.kept) return;
  for (size_t i = 0; i < result.world_T_base.size(); ++i)
    graph_.node(graph_.nodes()[i].id).world_T_base = result.world_T_base[i];
  for (LandmarkIndex i = 0; i < result.landmarks.size(); ++i)
    if (result.landmarks[i]) graph_.landmarks()[i].world_p = *result.landmarks[i];
}

void BaseStation::propose(KeyNodeId id) {
  const CTimeLoggerEntry timing(timer_, "loop_candidates");
  proposed_at_[id] = graph_.node(id).world_T_base.translation();
  std::vector<LoopClosureCandidate> candidates;
  for (const auto& generator : generators_)
    for (const LoopClosureCandidate& candidate : generator->propose(graph_, id))
      if (isWorthTrying(candidate)) candidates.push_back(candidate);
  candidate_count_ += queue_.push(std::move(candidates));
}

bool BaseStation::isWorthTrying(const LoopClosureCandidate& candidate) const {
  if (!inter_robot_loops_ && candidate.from.robot != candidate.to.robot) return false;
  if (!operator_.maySearch(candidate.from, candidate.to)) return false;
  const auto attempts = ledger_.attempts(candidate.from, candidate.to);
  if (attempts.empty()) return true;
  const LedgerRow& last = *attempts.back();
  if ((last.edge && !operator_.removed(*last.edge)) || last.attempt >= options_.max_attempts)
    return false;
  const Pose3 moved =
      last.guess.target_T_source.inverse() * graphGuess(graph_, candidate).target_T_source;
  return moved.translation().norm() >= options_.retry_distance_m;
}

void BaseStation::computeRound(size_t budget, const std::atomic<bool>& interrupted) {
  if (queue_.size() == 0) return;
  const MarginalCovariances uncertainty(graph_);
  std::vector<LoopClosureCandidate> candidates;
  {
    const CTimeLoggerEntry timing(timer_, "loop_priority");
    candidates = queue_.take(budget, *priority_, graph_, uncertainty);
    // An operator may have ruled a pair out while it waited.
    const auto superfluous = [&](const LoopClosureCandidate& c) { return !isWorthTrying(c); };
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(), superfluous),
                     candidates.end());
  }
  ++round_;

  std::vector<Guess> guesses;
  {
    const CTimeLoggerEntry timing(timer_, "uncertainty");
    guesses = graphGuesses(graph_, candidates, uncertainty);
  }
  std::vector<std::optional<LoopClosureAttempt>> attempts(candidates.size());
  {
    const CTimeLoggerEntry timing(timer_, "registration");
    tbb::parallel_for(size_t{0}, candidates.size(), [&](size_t i) {
      if (interrupted) return;
      const PreparedScanPtr source = scans_.get(scans_.source(candidates[i]));
      const PreparedScanPtr target = scans_.get(scans_.target(candidates[i]));
      attempts[i] = computation_.compute(*source, *target, guesses[i], candidates[i].certain_guess);
    });
  }
  for (size_t i = 0; i < candidates.size(); ++i)
    if (attempts[i]) record(candidates[i], guesses[i], std::move(*attempts[i]), i);
}

void BaseStation::record(const LoopClosureCandidate& candidate, const Guess& guess,
                         LoopClosureAttempt attempt, size_t rank) {
  LedgerRow row;
  row.round = round_;
  row.rank = rank;
  row.candidate = candidate;
  row.guess = guess;
  if (attempt.accepted) {
    Edge edge;
    edge.type = EdgeType::kLoopClosure;
    edge.from = candidate.from;
    edge.to = candidate.to;
    edge.from_T_to = attempt.result.target_T_source;
    edge.information = attempt.result.information;
    edge.verdict = Verdict::kPending;
    row.edge = graph_.addEdge(edge);
    ++loops_;
    optimized_all_ = false;
  }
  attempt.alignments = {};  // the ledger keeps the refined pose only
  row.outcome = std::move(attempt);
  ledger_.add(std::move(row));
}

bool BaseStation::optimizationDue() const {
  if (operator_.frozen()) return false;
  const auto waiting = static_cast<double>(loops_ - optimized_loops_);
  return waiting >= std::max(static_cast<double>(options_.optimize_min_loops),
                             options_.optimize_growth * static_cast<double>(loops_));
}

void BaseStation::optimize() {
  if (operator_.frozen()) return;
  const CTimeLoggerEntry timing(timer_, "pose_graph");
  const OptimizationResult result = solve();
  std::vector<Verdict> before;
  for (const Edge& edge : graph_.edges()) before.push_back(edge.verdict);
  report_ = result.report;
  ++optimization_count_;
  optimized_loops_ = loops_;
  optimized_all_ = true;
  if (!report_.usable) {
    MRPT_LOG_WARN_STREAM("optimisation failed, poses stay as they are: " << report_.termination);
    return;
  }
  applyResult(result, graph_);
  for (EdgeIndex i = 0; i < before.size(); ++i)
    if (graph_.edges()[i].verdict != before[i])
      ledger_.addVerdictChange(i, round_, before[i], graph_.edges()[i]);
  proposeAgain();
}

OptimizationResult BaseStation::solve() {
  const auto optimized = [&] {
    std::vector<bool> admitted = operator_.admitted(graph_);
    placements_.exclude(graph_, admitted);
    return back_end_.optimize(graph_, admitted);
  };
  OptimizationResult result = optimized();
  while (result.report.usable && misplaced(result)) {
    back_end_.optimizer->forget();
    result = optimized();
  }
  placements_.describe(result.report.frames);
  return result;
}

bool BaseStation::misplaced(const OptimizationResult& result) {
  const CTimeLoggerEntry timing(timer_, "robot_placements");
  if (!placements_.judge(graph_, result)) return false;
  ++round_;
  std::vector<PlacedLoop> loops = placements_.takeLoops();
  candidate_count_ += loops.size();
  size_t rank = 0;
  for (PlacedLoop& loop : loops) {
    LoopClosureCandidate candidate{loop.from, loop.to, "RobotPlacements"};
    candidate.why = "another placement";
    record(candidate, loop.guess, std::move(loop.attempt), rank++);
  }
  return true;
}

void BaseStation::proposeAgain() {
  const std::set<RobotId> met = robotsThatMet();
  for (const Node& node : graph_.nodes()) {
    const Eigen::Vector3d moved = node.world_T_base.translation() - proposed_at_.at(node.id);
    if (moved.norm() >= options_.repropose_distance_m || met.count(node.id.robot) > 0)
      propose(node.id);
  }
}

std::set<RobotId> BaseStation::robotsThatMet() {
  std::set<RobotId> met;
  const std::vector<RobotId> robots = graph_.robots();
  for (size_t i = 0; i < robots.size(); ++i)
    for (size_t k = 0; k < i; ++k)
      if (graph_.shareFrame(robots[k], robots[i]) &&
          share_frame_.insert({robots[k], robots[i]}).second)
        met.insert(robots[i]);
  return met;
}

}  // namespace lamp
