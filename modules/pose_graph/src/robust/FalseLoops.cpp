#include "lamp/pose_graph/FalseLoops.h"

#include <cmath>
#include <random>

namespace lamp {

namespace {

/** Random draws that are the same with every standard library. */
class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}

  size_t below(size_t size) { return static_cast<size_t>(engine_() % size); }
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / 18446744073709551616.0;
  }
  Pose3 pose(const Eigen::Vector3d& extent, bool planar) {
    Eigen::Vector3d t;
    for (int i = 0; i < 3; ++i) t[i] = uniform(-extent[i], extent[i]);
    if (planar) return planarPose(t.x(), t.y(), uniform(-M_PI, M_PI));
    Pose3 result = Pose3::Identity();
    result.translation() = t;
    result.linear() = rotation().toRotationMatrix();
    return result;
  }

 private:
  /** Uniform over all rotations (Shoemake 1992). */
  Eigen::Quaterniond rotation() {
    const double u = uniform(0, 1), a = uniform(0, 2 * M_PI), b = uniform(0, 2 * M_PI);
    return {std::sqrt(1 - u) * std::sin(a), std::sqrt(1 - u) * std::cos(a),
            std::sqrt(u) * std::sin(b), std::sqrt(u) * std::cos(b)};
  }

  std::mt19937_64 engine_;
};

Eigen::Vector3d extentOf(const PoseGraph& graph) {
  Eigen::AlignedBox3d box;
  for (const Node& node : graph.nodes()) box.extend(node.world_T_base.translation());
  return box.sizes();
}

bool farApart(KeyNodeId a, KeyNodeId b) {
  if (a.robot != b.robot) return true;
  return std::max(a.index, b.index) - std::min(a.index, b.index) > 1;
}

}  // namespace

void addFalseLoops(PoseGraph& graph, double share, unsigned seed) {
  std::vector<Edge> loops;
  for (const Edge& edge : graph.edges())
    if (edge.isLoopClosure()) loops.push_back(edge);
  const size_t count = loops.size(), nodes = graph.nodes().size();
  if (count == 0 || nodes < 3) return;
  const auto wanted = static_cast<size_t>(std::lround(share / (1.0 - share) * count));
  const Eigen::Vector3d extent = extentOf(graph);
  Dice dice(seed);
  for (size_t added = 0; added < wanted;) {
    Edge edge = loops[dice.below(count)];
    edge.from = graph.nodes()[dice.below(nodes)].id;
    edge.to = graph.nodes()[dice.below(nodes)].id;
    edge.from_T_to = dice.pose(extent, graph.planar());
    if (!farApart(edge.from, edge.to)) continue;
    graph.addEdge(edge);
    ++added;
  }
}

}  // namespace lamp
