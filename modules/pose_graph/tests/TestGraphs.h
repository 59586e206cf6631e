#pragma once

#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "lamp/core/G2oFile.h"
#include "lamp/core/GraphFiles.h"
#include "lamp/core/PoseGraph.h"
#include "lamp/pose_graph/InitialGuess.h"
#include "lamp/pose_graph/OutlierRejection.h"

namespace lamp {

inline KeyNodeId key_node(int robot, int index) {
  return {RobotId{static_cast<uint16_t>(robot)}, static_cast<uint32_t>(index)};
}

/** Seeded noise and random poses. */
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double normal(double sigma = 1.0) { return sigma * normal_(engine_); }
  double uniform(double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>()(engine_);
  }
  size_t below(size_t size) { return static_cast<size_t>(engine_() % size); }
  Vector6d tangent(double sigma_m, double sigma_rad) {
    Vector6d d;
    for (int i = 0; i < 6; ++i) d[i] = normal(i < 3 ? sigma_m : sigma_rad);
    return d;
  }
  Pose3 pose(double range_m, double range_rad, bool planar = false) {
    if (planar)
      return planarPose(uniform(-range_m, range_m), uniform(-range_m, range_m),
                        uniform(-range_rad, range_rad));
    Vector6d d;
    for (int i = 0; i < 6; ++i) {
      const double range = i < 3 ? range_m : range_rad;
      d[i] = uniform(-range, range);
    }
    return expSE3(d);
  }

 private:
  std::mt19937 engine_;
  std::normal_distribution<double> normal_;
};

inline Matrix6d informationOf(double sigma_m, double sigma_rad) {
  Vector6d diagonal;
  diagonal << Eigen::Vector3d::Constant(1 / (sigma_m * sigma_m)),
      Eigen::Vector3d::Constant(1 / (sigma_rad * sigma_rad));
  return diagonal.asDiagonal();
}

inline Edge makeEdge(EdgeType type, KeyNodeId from, KeyNodeId to, const Pose3& from_T_to,
                     const Matrix6d& information) {
  Edge edge;
  edge.type = type;
  edge.from = from;
  edge.to = to;
  edge.from_T_to = from_T_to;
  edge.information = information;
  edge.verdict = type == EdgeType::kLoopClosure ? Verdict::kPending : Verdict::kInlier;
  return edge;
}

/** A file's graph as one robot's. The nodes start at the odometry chain, and the first gets a tight
 * prior at the origin. */
inline PoseGraph readG2o(const std::string& path) {
  const PoseGraph file = readG2oFile(path).graph;
  const KeyNodeId first = file.nodes().front().id;
  PoseGraph graph;
  for (const Node& node : file.nodes()) graph.addNode(node);
  graph.addEdge(
      makeEdge(EdgeType::kPrior, first, first, Pose3::Identity(), informationOf(1e-3, 1e-3)));
  for (const Edge& edge : file.edges()) graph.addEdge(edge);
  const std::vector<Pose3> guess = initialGuess(graph);
  for (size_t i = 0; i < guess.size(); ++i) graph.node(graph.nodes()[i].id).world_T_base = guess[i];
  return graph;
}

/** A small world with known truth: robots that drive circles beside each other. */
struct WorldOptions {
  unsigned seed = 1;
  int robots = 2;
  int nodes = 90;  ///< of each robot; 30 make a lap
  int loops = 60;
  int outliers = 0;
  bool planar = false;
  bool priors = true;  ///< for all robots, else for the first only
};

struct World {
  PoseGraph graph;
  std::vector<Pose3> truth;     ///< world_T_base in node order
  std::vector<bool> true_edge;  ///< false for the seeded outliers, in edge order
};

inline Pose3 trueWorldPose(const WorldOptions& options, int robot, int index) {
  const double angle = 2 * M_PI * index / 30.0, radius = 10.0 + 0.02 * index;
  Vector6d p;
  p << 12.0 * robot + radius * std::cos(angle), radius * std::sin(angle), 0.02 * index,
      angle + M_PI / 2, 0.05 * std::sin(angle), 0.03;
  const Pose3 pose = poseFromYawPitchRoll(p);
  return options.planar ? projectToPlane(pose) : pose;
}

inline World makeWorld(const WorldOptions& options) {
  Random random(options.seed);
  World world;
  const double odometry_m = 0.02, odometry_rad = 0.004, loop_m = 0.05, loop_rad = 0.01;
  const auto noisy = [&](const Pose3& T, double sigma_m, double sigma_rad) {
    const Pose3 measured = T * expSE3(random.tangent(sigma_m, sigma_rad));
    return options.planar ? projectToPlane(measured) : measured;
  };
  const auto add = [&](const Edge& edge, bool is_true) {
    world.graph.addEdge(edge);
    world.true_edge.push_back(is_true);
  };
  const auto truth = [&](KeyNodeId id) { return world.truth[world.graph.place(id)]; };

  for (int robot = 0; robot < options.robots; ++robot) {
    for (int i = 0; i < options.nodes; ++i) {
      Node node;
      node.id = key_node(robot, i);
      node.planar = options.planar;
      world.graph.addNode(node);
      world.truth.push_back(trueWorldPose(options, robot, i));
      if (i == 0) {
        if (robot == 0 || options.priors)
          add(makeEdge(EdgeType::kPrior, node.id, node.id, world.truth.back(),
                       informationOf(1e-3, 1e-3)),
              true);
        continue;
      }
      const KeyNodeId last = key_node(robot, i - 1);
      add(makeEdge(EdgeType::kOdometry, last, node.id,
                   noisy(truth(last).inverse() * truth(node.id), odometry_m, odometry_rad),
                   informationOf(odometry_m, odometry_rad)),
          true);
    }
  }
  const auto randomPair = [&] {
    for (;;) {
      const KeyNodeId a = world.graph.nodes()[random.below(world.truth.size())].id;
      const KeyNodeId b = world.graph.nodes()[random.below(world.truth.size())].id;
      if (a.robot != b.robot || a.index > b.index + 5) return std::make_pair(a, b);
    }
  };
  for (int count = 0; count < options.loops;) {
    const auto [a, b] = randomPair();
    const Pose3 a_T_b = truth(a).inverse() * truth(b);
    if (a_T_b.translation().norm() > 4.0) continue;
    add(makeEdge(EdgeType::kLoopClosure, a, b, noisy(a_T_b, loop_m, loop_rad),
                 informationOf(loop_m, loop_rad)),
        true);
    ++count;
  }
  for (int count = 0; count < options.outliers; ++count) {
    const auto [a, b] = randomPair();
    add(makeEdge(EdgeType::kLoopClosure, a, b, random.pose(8.0, 3.0, options.planar),
                 informationOf(loop_m, loop_rad)),
        false);
  }
  const std::vector<Pose3> guess = initialGuess(world.graph);
  for (size_t i = 0; i < guess.size(); ++i)
    world.graph.node(world.graph.nodes()[i].id).world_T_base = guess[i];
  return world;
}

/** All edges may take part. */
inline Admission everything(const PoseGraph& graph) {
  return Admission(std::vector<bool>(graph.edges().size(), true));
}

/** Folder of the recordings, or empty if it is not there. */
inline std::string dataFolder() {
  const char* const set = std::getenv("LAMP_DATA");
  const std::string folder = set ? set : std::string(LAMP_SOURCE_DIR) + "/../shared/data";
  return std::filesystem::is_directory(folder) ? folder : "";
}

/** Mean distance of positions, metres. */
inline double meanDistance(const std::vector<Pose3>& a, const std::vector<Pose3>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += (a[i].translation() - b[i].translation()).norm();
  return sum / static_cast<double>(a.size());
}

}  // namespace lamp
