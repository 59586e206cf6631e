#include "lamp/base_station/OperatorState.h"

#include <cmath>

namespace lamp {

namespace {

const char* const kDone = "done";

/** The key node with this name. \throws std::runtime_error if there is none, with the same message
 * whether its robot is known yet or not: how far reading has run ahead is a matter of chance. */
KeyNodeId keyNode(const std::string& name, const RobotTable& robots, const PoseGraph& graph) {
  try {
    const KeyNodeId id = robots.parse(name);
    if (graph.contains(id)) return id;
  } catch (const std::runtime_error&) {
  }
  throw std::runtime_error("there is no key node " + name + " yet");
}

}  // namespace

std::string OperatorState::apply(const OperatorAction& action, size_t round,
                                 const RobotTable& robots, PoseGraph& graph, Ledger& ledger) {
  std::string outcome;
  try {
    outcome = change(action, round, robots, graph, ledger);
  } catch (const std::runtime_error& error) {  // of names that say nothing
    outcome = error.what();
  }
  pinEdges(graph);
  return outcome;
}

std::string OperatorState::change(const OperatorAction& action, size_t round,
                                  const RobotTable& robots, PoseGraph& graph, Ledger& ledger) {
  switch (action.kind) {
    case ActionKind::kAdd:
      return add(action, round, robots, graph, ledger);
    case ActionKind::kIgnore:
    case ActionKind::kRevive:
      return applyToRobot(action, robots, graph);
    case ActionKind::kFreeze:
    case ActionKind::kUnfreeze:
      frozen_ = action.kind == ActionKind::kFreeze;
      return kDone;
    case ActionKind::kReset:
      reset();
      return kDone;
    default:
      return applyToLoop(action, robots, graph, ledger);
  }
}

std::string OperatorState::applyToLoop(const OperatorAction& action, const RobotTable& robots,
                                       const PoseGraph& graph, const Ledger& ledger) {
  const LedgerRow* loop = nullptr;
  if (action.loop_id) {
    loop = ledger.accepted(*action.loop_id);
  } else {
    const KeyNodeId from = keyNode(action.from, robots, graph);
    const KeyNodeId to = keyNode(action.to, robots, graph);
    for (const auto& [a, b] : {Pair(from, to), Pair(to, from)})
      for (const LedgerRow* attempt : ledger.attempts(a, b))
        if (attempt->edge) loop = attempt;
  }
  if (!loop) return "no such loop closure has been verified yet";
  const Pair pair(loop->candidate.from, loop->candidate.to);
  restore(*loop->edge, pair);
  const bool by_hand = action.kind == ActionKind::kRestore && added_.count(*loop->edge);
  if (action.kind == ActionKind::kPin || by_hand) pinned_.insert(*loop->edge);
  if (action.kind == ActionKind::kRemove || action.kind == ActionKind::kVeto)
    removed_.insert(*loop->edge);
  if (action.kind == ActionKind::kVeto) vetoed_.insert(pair);
  return kDone;
}

void OperatorState::restore(EdgeIndex edge, Pair pair) {
  removed_.erase(edge);
  vetoed_.erase(pair);
  pinned_.erase(edge);
}

std::string OperatorState::add(const OperatorAction& action, size_t round, const RobotTable& robots,
                               PoseGraph& graph, Ledger& ledger) {
  LedgerRow row;
  row.round = round;
  row.candidate = {keyNode(action.from, robots, graph), keyNode(action.to, robots, graph),
                   "operator", 0};
  if (row.candidate.from == row.candidate.to) return "a loop closure needs two key nodes";
  Edge edge;
  edge.type = EdgeType::kLoopClosure;
  edge.from = row.candidate.from;
  edge.to = row.candidate.to;
  edge.from_T_to = Eigen::Translation3d(action.position) * action.rotation.normalized();
  Vector6d sigmas;
  sigmas.head<3>().setConstant(action.sigma_m);
  sigmas.tail<3>().setConstant(action.sigma_deg * M_PI / 180.0);
  edge.information = sigmas.cwiseAbs2().cwiseInverse().asDiagonal();
  row.edge = graph.addEdge(edge);
  pinned_.insert(*row.edge);
  added_.insert(*row.edge);
  row.guess.target_T_source =
      graph.node(edge.from).world_T_base.inverse() * graph.node(edge.to).world_T_base;
  row.outcome.accepted = true;
  row.outcome.stage = "operator";
  row.outcome.result.target_T_source = edge.from_T_to;
  row.outcome.result.information = edge.information;
  ledger.add(std::move(row));
  return kDone;
}

std::string OperatorState::applyToRobot(const OperatorAction& action, const RobotTable& robots,
                                        const PoseGraph& graph) {
  const std::optional<RobotId> robot = robots.find(action.robot);
  if (!robot || graph.robotNodes(*robot).empty())
    return "there is no key node of a robot '" + action.robot + "' yet";
  if (action.kind == ActionKind::kIgnore)
    ignored_.insert(*robot);
  else
    ignored_.erase(*robot);
  return kDone;
}

void OperatorState::reset() {
  pinned_.clear();
  removed_ = added_;
  vetoed_.clear();
  ignored_.clear();
  frozen_ = false;
}

void OperatorState::pinEdges(PoseGraph& graph) const {
  const std::vector<bool> admitted = this->admitted(graph);
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    Edge& edge = graph.edges()[e];
    edge.pinned = admitted[e] && pinned_.count(e);
    if (!edge.pinned) continue;
    edge.verdict = Verdict::kInlier;
    edge.weight = 1.0;
  }
}

std::vector<bool> OperatorState::admitted(const PoseGraph& graph) const {
  std::vector<bool> admitted;
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    const bool ignored = (edge.betweenRobots() || edge.endsAtLandmark()) &&
                         (ignored_.count(edge.from.robot) || ignored_.count(edge.to.robot));
    admitted.push_back(!ignored && !removed_.count(e));
  }
  return admitted;
}

bool OperatorState::maySearch(KeyNodeId from, KeyNodeId to) const {
  if (vetoed_.count({from, to})) return false;
  return from.robot == to.robot || (!ignored_.count(from.robot) && !ignored_.count(to.robot));
}

}  // namespace lamp
