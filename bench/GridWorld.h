#pragma once

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "TestGraphs.h"

namespace lamp {

/** A robot that drives along the lines of a lattice in space and turns at random, a metre between
 * key nodes, about one of them at each point of the lattice; each key node on average has a loop
 * closure with one that passed here, or at a point beside. Estimates are the odometry chain. */
class GridWorld {
 public:
  explicit GridWorld(int poses, unsigned seed = 1)
      : random_(seed), side_(static_cast<int>(std::round(std::cbrt(poses)))) {
    drive(poses);
    for (int i = 0; i < poses; ++i) addNode(i);
    while (static_cast<int>(pairs_.size()) < poses) addLoop();
    const std::vector<Pose3> guess = initialGuess(graph_);
    for (int i = 0; i < poses; ++i) graph_.node(key_node(0, i)).world_T_base = guess[i];
  }

  const PoseGraph& graph() const { return graph_; }

 private:
  using Point = std::array<int, 3>;

  void drive(int poses) {
    Point point{side_ / 2, side_ / 2, side_ / 2};
    Point heading{1, 0, 0};
    for (int i = 0; i < poses; ++i) {
      truth_.push_back(pose(point, heading));
      points_.push_back(point);
      at_[point].push_back(i);
      if (random_.uniform(0, 1) < 0.3) heading = turned(heading);
      while (!inside(sum(point, heading))) heading = turned(heading);
      point = sum(point, heading);
    }
  }

  Point turned(const Point& heading) {
    size_t axis = 0;
    while (heading[axis] == 0) ++axis;
    Point result{0, 0, 0};
    result[(axis + 1 + random_.below(2)) % 3] = random_.below(2) == 0 ? 1 : -1;
    return result;
  }

  static Point sum(Point a, const Point& b) {
    for (size_t i = 0; i < 3; ++i) a[i] += b[i];
    return a;
  }

  bool inside(const Point& point) const {
    for (const int x : point)
      if (x < 0 || x >= side_) return false;
    return true;
  }

  static Pose3 pose(const Point& point, const Point& heading) {
    Pose3 result = Pose3::Identity();
    result.translation() << point[0], point[1], point[2];
    result.linear() =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(),
                                           Eigen::Vector3d(heading[0], heading[1], heading[2]))
            .toRotationMatrix();
    return result;
  }

  void addNode(int i) {
    Node node;
    node.id = key_node(0, i);
    graph_.addNode(node);
    if (i == 0)
      graph_.addEdge(
          makeEdge(EdgeType::kPrior, node.id, node.id, truth_[0], informationOf(1e-3, 1e-3)));
    else
      addEdge(EdgeType::kOdometry, i - 1, i, 0.02, 0.002);
  }

  void addLoop() {
    const int a = static_cast<int>(random_.below(points_.size()));
    Point near = points_[a];
    for (int& x : near) x += static_cast<int>(random_.below(3)) - 1;
    const auto found = at_.find(near);
    if (found == at_.end()) return;
    const int b = found->second[random_.below(found->second.size())];
    if (std::abs(a - b) < 5 || !pairs_.insert({std::min(a, b), std::max(a, b)}).second) return;
    addEdge(EdgeType::kLoopClosure, a, b, 0.05, 0.005);
  }

  void addEdge(EdgeType type, int a, int b, double sigma_m, double sigma_rad) {
    const Pose3 measured =
        truth_[a].inverse() * truth_[b] * expSE3(random_.tangent(sigma_m, sigma_rad));
    graph_.addEdge(makeEdge(type, key_node(0, a), key_node(0, b), measured,
                            informationOf(sigma_m, sigma_rad)));
  }

  Random random_;
  int side_;
  std::vector<Point> points_;
  std::vector<Pose3> truth_;
  std::map<Point, std::vector<int>> at_;
  std::set<std::pair<int, int>> pairs_;
  PoseGraph graph_;
};

}  // namespace lamp
