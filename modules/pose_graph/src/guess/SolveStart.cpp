#include "guess/SolveStart.h"

#include <algorithm>

#include "guess/LandmarkGuess.h"
#include "lamp/core/DisjointSets.h"

namespace lamp {

namespace {

/** Frames of the robots and the world, joined by fixed key nodes, priors, and admitted loop
 * closures. */
class Frames {
 public:
  Frames(const PoseGraph& graph, const std::vector<bool>& admitted)
      : robots_(graph.robots()), sets_(robots_.size() + 1) {
    for (const Node& node : graph.nodes())
      if (node.fixed) sets_.join(number(node.id), kWorld);
    for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
      const Edge& edge = graph.edges()[e];
      if (edge.type == EdgeType::kPrior) sets_.join(number(edge.from), kWorld);
      if (edge.isLoopClosure() && edge.betweenRobots() && admitted[e])
        sets_.join(number(edge.from), number(edge.to));
    }
  }

  size_t ofRobot(KeyNodeId id) { return sets_.root(number(id)); }
  size_t ofWorld() { return sets_.root(kWorld); }

 private:
  static constexpr size_t kWorld = 0;

  size_t number(KeyNodeId id) const {
    const auto place = std::lower_bound(robots_.begin(), robots_.end(), id.robot);
    return 1 + static_cast<size_t>(place - robots_.begin());
  }

  std::vector<RobotId> robots_;
  DisjointSets sets_;
};

/** A landmark is in the frame of the robot that saw it first. */
void dropUnrelated(const PoseGraph& graph, std::vector<bool>& admitted) {
  Frames frames(graph, admitted);
  std::vector<std::optional<size_t>> frame(graph.landmarks().size());
  for (LandmarkIndex i = 0; i < frame.size(); ++i)
    if (graph.landmarks()[i].known) frame[i] = frames.ofWorld();
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (!admitted[e]) continue;
    const size_t mine = frames.ofRobot(edge.from);
    if (edge.type == EdgeType::kRobotRange && frames.ofRobot(edge.to) != mine) admitted[e] = false;
    if (!edge.endsAtLandmark()) continue;
    if (!frame[edge.landmark]) frame[edge.landmark] = mine;
    if (frame[edge.landmark] != mine) admitted[e] = false;
  }
}

}  // namespace

SolveStart completeStart(const PoseGraph& graph, std::vector<Pose3> world_T_base,
                         std::vector<bool> admitted) {
  dropUnrelated(graph, admitted);
  const auto landmarks = landmarkGuess(graph, world_T_base, admitted);
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (edge.endsAtLandmark() && !landmarks[edge.landmark]) admitted[e] = false;
  }
  for (const auto& landmark : landmarks)
    world_T_base.emplace_back(Eigen::Translation3d(landmark.value_or(Eigen::Vector3d::Zero())));
  return {std::move(world_T_base), std::move(admitted)};
}

PoseGraph judged(PoseGraph graph, const std::vector<bool>& admitted) {
  for (EdgeIndex e = 0; e < admitted.size(); ++e) {
    Edge& edge = graph.edges()[e];
    if (edge.mayBeRejected()) edge.verdict = admitted[e] ? Verdict::kInlier : Verdict::kOutlier;
  }
  return graph;
}

void splitSolution(const PoseGraph& graph, const SolveStart& start, std::vector<Pose3> solution,
                   OptimizationResult& result) {
  const size_t nodes = graph.nodes().size();
  result.landmarks.assign(graph.landmarks().size(), std::nullopt);
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (!edge.endsAtLandmark() || !start.admitted[e]) continue;
    Eigen::Vector3d p = solution[nodes + edge.landmark].translation();
    if (graph.planar()) p.z() = start.poses[nodes + edge.landmark].translation().z();
    result.landmarks[edge.landmark] = p;
  }
  solution.resize(nodes);
  result.world_T_base = std::move(solution);
}

}  // namespace lamp
