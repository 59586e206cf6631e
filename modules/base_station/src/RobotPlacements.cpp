#include "lamp/base_station/RobotPlacements.h"

#include <algorithm>

#include "lamp/base_station/PlacementVerdict.h"
#include "lamp/core/DisjointSets.h"

namespace lamp {

namespace {

/** Key nodes of the robot in the first component that has any. */
RobotMap robotMap(const PoseGraph& graph, RobotId robot) {
  RobotMap map;
  for (const Component& component : graph.components()) {
    for (const KeyNodeId id : component.nodes) {
      if (id.robot != robot) continue;
      map.nodes.push_back(id);
      map.map_T_node.push_back(graph.node(id).world_T_base);
    }
    if (!map.nodes.empty()) break;
  }
  return map;
}

size_t keyNodes(const PoseGraph& graph, RobotId a, RobotId b) {
  return graph.robotNodes(a).size() + graph.robotNodes(b).size();
}

/** A key node in the frame of its robot's first one. */
Pose3 firstTNode(const PoseGraph& graph, KeyNodeId id) {
  return graph.node(graph.robotNodes(id.robot).front()).world_T_base.inverse() *
         graph.node(id).world_T_base;
}

}  // namespace

void RobotPlacements::exclude(const PoseGraph& graph, std::vector<bool>& admitted) const {
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (!edge.isLoopClosure() || edge.pinned || !edge.betweenRobots()) continue;
    const auto found = answers_.find(std::minmax(edge.from.robot, edge.to.robot));
    if (found != answers_.end() && excludes(found->second, graph, edge)) admitted[e] = false;
  }
}

bool RobotPlacements::judge(const PoseGraph& graph, const OptimizationResult& result) {
  std::vector<FrameAgreement> frames = result.report.frames;
  if (frames.empty()) return false;
  std::stable_sort(frames.begin(), frames.end(),
                   [](const auto& a, const auto& b) { return a.agreeing > b.agreeing; });
  PoseGraph joined;
  bool refused = false;
  DisjointSets sure(graph.robots().back().value + size_t{1});
  for (const FrameAgreement& agreement : frames) {
    if (agreement.agreeing < agreement.needed || !agreement.joined ||
        sure.joined(agreement.a.value, agreement.b.value))
      continue;
    const Robots robots = std::minmax(agreement.a, agreement.b);
    const auto found = answers_.find(robots);
    if (found == answers_.end() || !holds(found->second, graph)) {
      if (joined.nodes().empty()) {
        joined = graph;
        applyResult(result, joined);
      }
      answers_[robots] = answer(joined, agreement);
      refused = refused || answers_[robots].apart || !answers_[robots].as_joined;
    }
    if (!answers_[robots].apart) sure.join(agreement.a.value, agreement.b.value);
  }
  return refused;
}

void RobotPlacements::describe(std::vector<FrameAgreement>& frames) const {
  size_t robots = 0;
  for (const auto& [pair, answer] : answers_)
    robots = std::max<size_t>(robots, pair.second.value + size_t{1});
  DisjointSets joined(robots);  // two robots that stay apart may both be joined with a third one
  for (const FrameAgreement& agreement : frames)
    if (agreement.joined && std::max(agreement.a, agreement.b).value < robots)
      joined.join(agreement.a.value, agreement.b.value);
  const auto isListed = [&](RobotId a, RobotId b) {
    return std::any_of(frames.begin(), frames.end(), [&](const FrameAgreement& agreement) {
      return Robots(std::minmax(agreement.a, agreement.b)) == Robots(a, b);
    });
  };
  for (const auto& [pair, answer] : answers_)
    if (answer.apart && !joined.joined(pair.first.value, pair.second.value) &&
        !isListed(pair.first, pair.second))
      frames.push_back(answer.agreement);
}

bool RobotPlacements::askForLastAnswers(const PoseGraph& graph) {
  growth_ = 1.0;
  return std::any_of(answers_.begin(), answers_.end(),
                     [&](const auto& entry) { return !holds(entry.second, graph); });
}

bool RobotPlacements::holds(const Answer& answer, const PoseGraph& graph) const {
  // Robots that are joined seldom turn out to be apart; those that are apart wait for the answer.
  constexpr double kLongerIfJoined = 1.3;
  const double growth = answer.apart ? growth_ : growth_ * kLongerIfJoined;
  return static_cast<double>(keyNodes(graph, answer.agreement.a, answer.agreement.b)) <=
         growth * static_cast<double>(answer.key_nodes);
}

RobotPlacements::Answer RobotPlacements::answer(const PoseGraph& joined,
                                                const FrameAgreement& agreement) {
  const RobotMap a = robotMap(joined, agreement.a), b = robotMap(joined, agreement.b);
  const PlacementScales scales(a, b, computation_, scans_);
  // Moves of b's map against a's, from where the loop closures have put it.
  std::vector<Placement> placements{scales.weigh(Pose3::Identity())};
  for (const Pose3& alternative : scales.alternatives(Pose3::Identity()))
    placements.push_back(scales.weigh(alternative));
  const PlacementVerdict verdict = lamp::judge(placements);

  const auto inFrames = [&](size_t k) {
    return Pose3(a.map_T_node.front().inverse() * placements[k].a_T_b * b.map_T_node.front());
  };
  Answer answer;
  answer.agreement = agreement;
  answer.agreement.joined = false;
  answer.key_nodes = keyNodes(joined, agreement.a, agreement.b);
  answer.best = inFrames(verdict.best);
  for (size_t k = 0; k < placements.size(); ++k)
    if (k != verdict.best) answer.others.push_back(inFrames(k));
  answer.apart = verdict.contradicted || !verdict.equally_good.empty();
  answer.as_joined = verdict.best == 0;
  if (!verdict.equally_good.empty()) answer.agreement.equally_good.push_back(answer.best);
  for (const size_t k : verdict.equally_good) answer.agreement.equally_good.push_back(inFrames(k));
  if (verdict.contradicted) answer.agreement.contradicting = verdict.contradicting;
  if (!answer.apart && !answer.as_joined)
    for (PlacedLoop& loop : scales.loops(placements[verdict.best].a_T_b))
      loops_.push_back(std::move(loop));
  return answer;
}

bool RobotPlacements::excludes(const Answer& answer, const PoseGraph& graph,
                               const Edge& edge) const {
  if (answer.apart) return holds(answer, graph);
  const bool in_order = edge.from.robot == answer.agreement.a;
  const KeyNodeId a = in_order ? edge.from : edge.to, b = in_order ? edge.to : edge.from;
  const Pose3 a_T_b = in_order ? edge.from_T_to : edge.from_T_to.inverse();
  const Pose3 measured = firstTNode(graph, a) * a_T_b, b_T_node = firstTNode(graph, b);
  if (samePlacement(answer.best * b_T_node, measured)) return false;
  return std::any_of(answer.others.begin(), answer.others.end(),
                     [&](const Pose3& other) { return samePlacement(other * b_T_node, measured); });
}

}  // namespace lamp
