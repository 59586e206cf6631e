#include "lamp/base_station/BaseStation.h"

#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>

#include "lamp/pose_graph/MarginalCovariances.h"

namespace lamp {

namespace {

using mrpt::system::CTimeLoggerEntry;

/** Moves the scans since the previous key node, and the key node's own, to the world. The
 * correction that optimisation made at the two key nodes is blended over the time between them. */
void appendCorrected(const std::vector<StampedPose>& passed, const StampedPose& before,
                     const Pose3& before_world, const StampedPose& after, const Pose3& after_world,
                     std::vector<StampedPose>& trajectory) {
  const Pose3 first = before_world * before.pose.inverse();
  const Pose3 last = after_world * after.pose.inverse();
  for (const StampedPose& scan : passed) {
    const double ratio = (scan.stamp - before.stamp) / (after.stamp - before.stamp);
    trajectory.push_back({scan.stamp, interpolate(first * scan.pose, last * scan.pose, ratio)});
  }
}

void appendMoved(const std::vector<StampedPose>& passed, const Pose3& world_T_odom,
                 std::vector<StampedPose>& trajectory) {
  for (const StampedPose& scan : passed)
    trajectory.push_back({scan.stamp, world_T_odom * scan.pose});
}

}  // namespace

BaseStation::BaseStation(const SlamConfig& config, mrpt::system::CTimeLogger& timer)
    : COutputLogger("base_station"),
      options_(config.base_station),
      inter_robot_loops_(config.pipeline.inter_robot_loops),
      stages_(config.stages),
      computation_(config.makeLoopClosureComputation()),
      timer_(timer),
      scans_(config.registration.preparation),
      extra_edges_(config.robots, config.beacons) {}

void BaseStation::receive(const KeyframePacket& packet) {
  registerNode(packet);
  propose(packet.id);
  computeRound(static_cast<size_t>(options_.closures_per_round));
  if (optimizationDue()) optimize();
}

void BaseStation::receive(const RobotEnd& end) {
  trailing_scans_[end.robot] = end.passed_scans;
  const auto& nodes = graph_.robotNodes(end.robot);
  if (nodes.empty()) return;
  if (extra_edges_.add(nodes.back(), end.extras, packets_, graph_)) optimized_all_ = false;
}

std::string BaseStation::apply(const OperatorAction& action, const RobotTable& robots) {
  const std::string outcome = operator_.apply(action, round_, robots, graph_, ledger_);
  actions_.push_back({action, outcome});
  if (outcome != "done") return outcome;
  if (action.kind == ActionKind::kReset) stages_.back_end.optimizer->forget();
  if (action.kind == ActionKind::kRevive || action.kind == ActionKind::kReset)
    for (const Node& node : graph_.nodes()) propose(node.id);
  optimize();
  return outcome;
}

void BaseStation::finish(const std::atomic<bool>& interrupted) {
  // Each optimisation can bring key nodes together that were too far apart before.
  do {
    if (!interrupted) computeRound(0);
    if (!optimized_all_ && !operator_.frozen()) optimize();
  } while (queue_.size() > 0 && !interrupted);
}

void BaseStation::registerNode(const KeyframePacket& packet) {
  Node node;
  node.id = packet.id;
  node.stamp = packet.stamp;
  node.odom_T_base = packet.odom_T_base;
  node.planar = packet.planar;
  const KeyframeId previous{packet.id.robot, packet.id.index - 1};
  if (packet.odometry)
    node.world_T_base =
        normalized(graph_.node(previous).world_T_base * packet.odometry->previous_T_this);
  else if (packet.prior)
    node.world_T_base = packet.prior->world_T_base;
  graph_.addNode(node);

  Edge edge;
  edge.to = packet.id;
  if (packet.odometry) {
    edge.type = EdgeType::kOdometry;
    edge.from = previous;
    edge.from_T_to = packet.odometry->previous_T_this;
    edge.information = packet.odometry->covariance.inverse();
    graph_.addEdge(edge);
  } else if (packet.prior) {
    edge.type = EdgeType::kPrior;
    edge.from = packet.id;
    edge.from_T_to = packet.prior->world_T_base;
    edge.information = packet.prior->covariance.inverse();
    graph_.addEdge(edge);
  }
  scans_.add(packet);
  packets_[packet.id] = packet;
  if (extra_edges_.add(packet.id, packet.extras, packets_, graph_)) optimized_all_ = false;
}

void BaseStation::propose(KeyframeId id) {
  const CTimeLoggerEntry timing(timer_, "loop_candidates");
  proposed_at_[id] = graph_.node(id).world_T_base.translation();
  std::vector<LoopClosureCandidate> candidates;
  for (const auto& generator : stages_.candidates)
    for (const LoopClosureCandidate& candidate : generator->propose(graph_, id))
      if (isWorthTrying(candidate)) candidates.push_back(candidate);
  candidate_count_ += candidates.size();
  queue_.push(std::move(candidates));
}

bool BaseStation::isWorthTrying(const LoopClosureCandidate& candidate) const {
  if (!inter_robot_loops_ && candidate.from.robot != candidate.to.robot) return false;
  if (!operator_.maySearch(candidate.from, candidate.to)) return false;
  const auto attempts = ledger_.attempts(candidate.from, candidate.to);
  if (attempts.empty()) return true;
  const LedgerRow& last = *attempts.back();
  if ((last.edge && !operator_.removed(*last.edge)) || last.attempt >= options_.max_attempts)
    return false;
  const Pose3 moved = last.guess.target_T_source.inverse() * guess(candidate).target_T_source;
  return moved.translation().norm() >= options_.retry_distance_m;
}

void BaseStation::computeRound(size_t budget) {
  if (queue_.size() == 0) return;
  const MarginalCovariances uncertainty(graph_);
  std::vector<LoopClosureCandidate> candidates;
  {
    const CTimeLoggerEntry timing(timer_, "loop_priority");
    candidates = queue_.take(budget, *stages_.priority, graph_, uncertainty);
    // Two generators may propose one pair; it may also have been computed while it waited.
    std::set<std::pair<KeyframeId, KeyframeId>> seen;
    const auto superfluous = [&](const LoopClosureCandidate& c) {
      return !seen.insert({c.from, c.to}).second || !isWorthTrying(c);
    };
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(), superfluous),
                     candidates.end());
  }
  ++round_;

  const std::vector<Guess> guesses = this->guesses(candidates, uncertainty);
  std::vector<LoopClosureAttempt> attempts(candidates.size());
  {
    const CTimeLoggerEntry timing(timer_, "registration");
    tbb::parallel_for(size_t{0}, candidates.size(), [&](size_t i) {
      const PreparedScanPtr source = scans_.get(scans_.source(candidates[i]));
      const PreparedScanPtr target = scans_.get(scans_.target(candidates[i]));
      attempts[i] = computation_.compute(*source, *target, guesses[i]);
    });
  }
  for (size_t i = 0; i < candidates.size(); ++i)
    record(candidates[i], guesses[i], std::move(attempts[i]), i);
}

Guess BaseStation::guess(const LoopClosureCandidate& candidate) const {
  return {
      graph_.node(candidate.from).world_T_base.inverse() * graph_.node(candidate.to).world_T_base,
      std::nullopt};
}

std::vector<Guess> BaseStation::guesses(const std::vector<LoopClosureCandidate>& candidates,
                                        const UncertaintyQuery& uncertainty) const {
  const CTimeLoggerEntry timing(timer_, "uncertainty");
  std::vector<Guess> result(candidates.size());
  std::map<KeyframeId, std::vector<size_t>> by_newer;
  for (size_t i = 0; i < candidates.size(); ++i) {
    result[i] = guess(candidates[i]);
    by_newer[candidates[i].to].push_back(i);
  }
  for (const auto& [newer, places] : by_newer) {
    std::vector<KeyframeId> older;
    for (const size_t i : places) older.push_back(candidates[i].from);
    const auto covariances = uncertainty.relativeCovariances(newer, older);
    for (size_t k = 0; k < places.size(); ++k) {
      if (!covariances[k]) continue;
      // (T · Exp(d))⁻¹ = T⁻¹ · Exp(-Ad(T) d), T the pose of the older node seen from the newer.
      Guess& guess = result[places[k]];
      const Matrix6d Ad = adjoint(guess.target_T_source.inverse());
      guess.covariance = Ad * *covariances[k] * Ad.transpose();
    }
  }
  return result;
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
  std::vector<Verdict> before;
  for (const Edge& edge : graph_.edges()) before.push_back(edge.verdict);

  const OptimizationResult result = stages_.back_end.optimize(graph_, operator_.admitted(graph_));
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

void BaseStation::proposeAgain() {
  for (const Node& node : graph_.nodes()) {
    const Eigen::Vector3d moved = node.world_T_base.translation() - proposed_at_.at(node.id);
    if (moved.norm() >= options_.repropose_distance_m) propose(node.id);
  }
}

std::vector<StampedPose> BaseStation::keyframeTrajectory(RobotId robot) const {
  std::vector<StampedPose> trajectory;
  for (const KeyframeId id : graph_.robotNodes(robot))
    trajectory.push_back({graph_.node(id).stamp, graph_.node(id).world_T_base});
  return trajectory;
}

std::vector<StampedPose> BaseStation::trajectory(RobotId robot) const {
  std::vector<StampedPose> result;
  const KeyframePacket* previous = nullptr;
  Pose3 world_T_odom = Pose3::Identity();
  for (const KeyframeId id : graph_.robotNodes(robot)) {
    const KeyframePacket& packet = packets_.at(id);
    const Pose3& world_T_base = graph_.node(id).world_T_base;
    world_T_odom = world_T_base * packet.odom_T_base.inverse();
    if (previous)
      appendCorrected(packet.passed_scans, {previous->stamp, previous->odom_T_base},
                      graph_.node(previous->id).world_T_base, {packet.stamp, packet.odom_T_base},
                      world_T_base, result);
    else
      appendMoved(packet.passed_scans, world_T_odom, result);
    result.push_back({packet.stamp, world_T_base});
    previous = &packet;
  }
  if (const auto trailing = trailing_scans_.find(robot); trailing != trailing_scans_.end())
    appendMoved(trailing->second, world_T_odom, result);
  return result;
}

std::vector<StampedPose> BaseStation::odometryTrajectory(RobotId robot) const {
  std::vector<StampedPose> result;
  Pose3 world_T_odom = Pose3::Identity();
  for (const KeyframeId id : graph_.robotNodes(robot)) {
    const KeyframePacket& packet = packets_.at(id);
    if (packet.prior)
      world_T_odom = packet.prior->world_T_base * packet.odom_T_base.inverse();
    else if (result.empty())
      world_T_odom = packet.odom_T_base.inverse();
    appendMoved(packet.passed_scans, world_T_odom, result);
    result.push_back({packet.stamp, world_T_odom * packet.odom_T_base});
  }
  if (const auto trailing = trailing_scans_.find(robot); trailing != trailing_scans_.end())
    appendMoved(trailing->second, world_T_odom, result);
  return result;
}

}  // namespace lamp
