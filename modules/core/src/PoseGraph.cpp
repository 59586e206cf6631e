#include "lamp/core/PoseGraph.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "lamp/core/DisjointSets.h"

namespace lamp {

namespace {

std::string describe(KeyNodeId id) {
  return std::to_string(id.robot.value) + ":" + std::to_string(id.index);
}

bool isInformation(const Matrix6d& m) {
  if (!m.allFinite()) return false;
  const double scale = m.cwiseAbs().maxCoeff();
  if ((m - m.transpose()).cwiseAbs().maxCoeff() > 1e-6 * scale) return false;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(m, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().minCoeff() >= -1e-9 * scale;
}

}  // namespace

const char* toString(EdgeType type) {
  switch (type) {
    case EdgeType::kOdometry:
      return "odometry";
    case EdgeType::kPrior:
      return "prior";
    case EdgeType::kLoopClosure:
      return "loop_closure";
    case EdgeType::kGravity:
      return "gravity";
    case EdgeType::kPosition:
      return "position";
    case EdgeType::kBearingRange:
      return "bearing_range";
    case EdgeType::kRange:
      return "range";
    case EdgeType::kRobotRange:
      return "robot_range";
  }
  return "";
}

const char* toString(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPending:
      return "pending";
    case Verdict::kInlier:
      return "inlier";
    case Verdict::kOutlier:
      return "outlier";
  }
  return "";
}

void PoseGraph::addNode(const Node& node) {
  if (!place_.emplace(node.id, nodes_.size()).second)
    throw std::logic_error("pose graph: key node " + describe(node.id) + " already exists");
  auto& of_robot = by_robot_[node.id.robot];
  of_robot.insert(std::upper_bound(of_robot.begin(), of_robot.end(), node.id), node.id);
  nodes_.push_back(node);
  planar_nodes_ += node.planar;
  if (node.fixed) in_world_.insert(node.id.robot);
}

EdgeIndex PoseGraph::addEdge(const Edge& edge) {
  const std::string name =
      std::string(toString(edge.type)) + " " + describe(edge.from) + " - " + describe(edge.to);
  if (!contains(edge.from) || !contains(edge.to))
    throw std::logic_error("pose graph: " + name + " has an end that is not in the graph");
  const bool needs_two = edge.joinsPoses() || edge.type == EdgeType::kRobotRange;
  if ((edge.from != edge.to) != needs_two)
    throw std::logic_error("pose graph: " + name + " must have " +
                           (needs_two ? "two key nodes" : "one key node"));
  if (edge.endsAtLandmark() && edge.landmark >= landmarks_.size())
    throw std::logic_error("pose graph: " + name + " has a landmark that is not in the graph");
  if (!isFinite(edge.from_T_to) || !edge.from_p_sensor.allFinite() || !edge.to_p_sensor.allFinite())
    throw std::invalid_argument("pose graph: the measurement of " + name + " is not finite");
  if (!isInformation(edge.information))
    throw std::invalid_argument("pose graph: the information matrix of " + name +
                                " is not finite, symmetric and positive semi-definite");
  edges_.push_back(edge);
  if (edge.type == EdgeType::kPrior) in_world_.insert(edge.from.robot);
  if (edge.isLoopClosure() && edge.betweenRobots())
    between_robots_[std::minmax(edge.from.robot, edge.to.robot)].push_back(edges_.size() - 1);
  return edges_.size() - 1;
}

LandmarkIndex PoseGraph::addLandmark(const Landmark& landmark) {
  if (!landmark_by_name_.emplace(landmark.name, landmarks_.size()).second)
    throw std::logic_error("pose graph: landmark '" + landmark.name + "' already exists");
  landmarks_.push_back(landmark);
  return landmarks_.size() - 1;
}

std::optional<LandmarkIndex> PoseGraph::findLandmark(const std::string& name) const {
  const auto found = landmark_by_name_.find(name);
  if (found == landmark_by_name_.end()) return std::nullopt;
  return found->second;
}

const std::vector<KeyNodeId>& PoseGraph::robotNodes(RobotId robot) const {
  static const std::vector<KeyNodeId> kNone;
  const auto found = by_robot_.find(robot);
  return found == by_robot_.end() ? kNone : found->second;
}

std::vector<RobotId> PoseGraph::robots() const {
  std::vector<RobotId> result;
  for (const auto& [robot, ids] : by_robot_) result.push_back(robot);
  std::sort(result.begin(), result.end());
  return result;
}

bool PoseGraph::shareFrame(RobotId a, RobotId b) const {
  if (a == b) return true;
  std::map<RobotId, RobotId> group;
  const auto root = [&](RobotId robot) {
    for (auto up = group.find(robot); up != group.end(); up = group.find(robot)) robot = up->second;
    return robot;
  };
  const auto join = [&](RobotId one, RobotId other) {
    if (root(one) != root(other)) group[root(one)] = root(other);
  };
  for (const RobotId robot : in_world_) join(robot, *in_world_.begin());
  const auto is_inlier = [&](EdgeIndex e) { return edges_[e].verdict == Verdict::kInlier; };
  for (const auto& [robots, loops] : between_robots_)
    if (root(robots.first) != root(robots.second) &&
        std::any_of(loops.begin(), loops.end(), is_inlier))
      join(robots.first, robots.second);
  return root(a) == root(b);
}

std::vector<Component> PoseGraph::components() const {
  DisjointSets sets(nodes_.size());
  for (const Edge& edge : edges_)
    if (edge.joinsPoses() && edge.active()) sets.join(place(edge.from), place(edge.to));

  std::map<size_t, Component> by_root;
  for (size_t i = 0; i < nodes_.size(); ++i) by_root[sets.root(i)].nodes.push_back(nodes_[i].id);

  std::vector<Component> components;
  for (auto& [root, component] : by_root) {
    std::sort(component.nodes.begin(), component.nodes.end());
    std::set<RobotId> robots;
    for (const KeyNodeId id : component.nodes) robots.insert(id.robot);
    component.robots.assign(robots.begin(), robots.end());
    components.push_back(std::move(component));
  }
  std::sort(components.begin(), components.end(), [](const Component& a, const Component& b) {
    if (a.nodes.size() != b.nodes.size()) return a.nodes.size() > b.nodes.size();
    return a.nodes.front() < b.nodes.front();
  });
  return components;
}

}  // namespace lamp
