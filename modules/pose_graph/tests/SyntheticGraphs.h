#pragma once

#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "TestGraphs.h"

namespace lamp {

/** Large graphs of the kinds that back ends find hard, with known truth. Seeded. Unlike
 * makeWorld(), drives are long, so that odometry says little of where they meet themselves. */
struct SyntheticOptions {
  unsigned seed = 1;
  int robots = 1;
  int nodes = 1000;  ///< of each robot
  double loops_a_node = 1;
  double gap_share = 0;  ///< of the odometry edges, those that are missing
  int pieces = 1;        ///< of each robot's drive, between gaps of odometry
  double odometry_m = 0.02, odometry_rad = 0.002;
  /** Errors of the turn that stay the same for hundreds of key nodes, as of a gyroscope. The stated
   * covariances know nothing of them. */
  double odometry_bias_rad = 0;
  double loop_m = 0.05, loop_rad = 0.005;
  /** Errors of loops along the direction of travel over the stated ones. */
  double overconfidence = 1;
  /** Places that were taken for others, and how many loops say so at each: they agree. */
  int mistaken_places = 0, loops_a_mistake = 10;
};

/** Builds a World from true poses and the pairs of key nodes that see the same place. */
class SyntheticWorld {
 public:
  using Pair = std::pair<KeyNodeId, KeyNodeId>;

  SyntheticWorld(const SyntheticOptions& options, bool planar)
      : options_(options),
        planar_(planar),
        random_(options.seed + 1000),
        biases_(options.seed + 2000) {}

  void addRobot(int robot, const std::vector<Pose3>& truth) {
    const size_t piece = truth.size() / static_cast<size_t>(options_.pieces) + 1;
    double bias = biases_.normal(options_.odometry_bias_rad);
    for (size_t i = 0; i < truth.size(); ++i) {
      Node node;
      node.id = key_node(robot, static_cast<int>(i));
      node.planar = planar_;
      world_.graph.addNode(node);
      world_.truth.push_back(truth[i]);
      if (i == 0) continue;
      bias += biases_.normal(options_.odometry_bias_rad * std::sqrt(2 / kBiasNodes)) -
              bias / kBiasNodes;  // a Gauss-Markov process
      const bool gap = random_.uniform(0, 1) < options_.gap_share || i % piece == 0;
      if (!gap) addOdometry(key_node(robot, static_cast<int>(i) - 1), node.id, bias);
    }
  }

  /** Some of the pairs, at random, in the order of driving. */
  World finish(std::vector<Pair> pairs) {
    const auto wanted = static_cast<size_t>(options_.loops_a_node * world_.graph.nodes().size());
    for (size_t i = 0; i < std::min(wanted, pairs.size()); ++i)
      std::swap(pairs[i], pairs[i + random_.below(pairs.size() - i)]);
    if (pairs.size() > wanted) pairs.resize(wanted);
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [a, b] : pairs) addLoop(a, b);
    for (int i = 0; i < options_.mistaken_places; ++i) mistakePlaces();
    const std::vector<Pose3> guess = initialGuess(world_.graph);
    for (size_t i = 0; i < guess.size(); ++i)
      world_.graph.node(world_.graph.nodes()[i].id).world_T_base = guess[i];
    return std::move(world_);
  }

 private:
  static constexpr double kBiasNodes = 300;

  Pose3 truth(KeyNodeId id) const { return world_.truth[world_.graph.place(id)]; }

  void addOdometry(KeyNodeId a, KeyNodeId b, double bias_rad) {
    const double m = options_.odometry_m, rad = options_.odometry_rad;
    const Pose3 turned = truth(a).inverse() * truth(b) * planarPose(0, 0, bias_rad);
    add(EdgeType::kOdometry, a, b, turned * expSE3(random_.tangent(m, rad)), m, rad, true);
  }

  void addLoop(KeyNodeId a, KeyNodeId b) {
    Vector6d error = random_.tangent(options_.loop_m, options_.loop_rad);
    error[0] *= options_.overconfidence;
    add(EdgeType::kLoopClosure, a, b, truth(a).inverse() * truth(b) * expSE3(error),
        options_.loop_m, options_.loop_rad, true);
  }

  /** The key nodes from b on are taken for seeing what those from a on see. */
  void mistakePlaces() {
    const int count = options_.loops_a_mistake;
    const KeyNodeId a = anyNode(count), b = anyNode(count);
    if (a.robot == b.robot && std::abs(static_cast<int>(a.index - b.index)) < 3 * count)
      return mistakePlaces();
    const Pose3 mistake = truth(a) * planarPose(0.5, 0.3, 0.1) * truth(b).inverse();
    for (int i = 0; i < count; ++i) {
      const KeyNodeId from = key_node(a.robot.value, static_cast<int>(a.index) + i);
      const KeyNodeId to = key_node(b.robot.value, static_cast<int>(b.index) + i);
      const Vector6d error = random_.tangent(options_.loop_m, options_.loop_rad);
      add(EdgeType::kLoopClosure, from, to,
          truth(from).inverse() * mistake * truth(to) * expSE3(error), options_.loop_m,
          options_.loop_rad, false);
    }
  }

  /** One that has `after` more behind it. */
  KeyNodeId anyNode(int after) {
    const auto robot = static_cast<int>(random_.below(options_.robots));
    return key_node(robot, static_cast<int>(random_.below(options_.nodes - after)));
  }

  void add(EdgeType type, KeyNodeId a, KeyNodeId b, const Pose3& measured, double sigma_m,
           double sigma_rad, bool is_true) {
    world_.graph.addEdge(makeEdge(type, a, b, planar_ ? projectToPlane(measured) : measured,
                                  informationOf(sigma_m, sigma_rad)));
    world_.true_edge.push_back(is_true);
  }

  const SyntheticOptions options_;
  const bool planar_;
  Random random_;
  Random biases_;
  World world_;
};

/** Pairs of key nodes at most `radius` apart; of one robot, at least `least_nodes` apart in time.
 */
inline std::vector<SyntheticWorld::Pair> meetings(const std::vector<std::vector<Pose3>>& robots,
                                                  double radius, int least_nodes) {
  using Cell = std::array<int, 3>;
  const auto cellOf = [&](const Eigen::Vector3d& p) {
    return Cell{static_cast<int>(std::floor(p.x() / radius)),
                static_cast<int>(std::floor(p.y() / radius)),
                static_cast<int>(std::floor(p.z() / radius))};
  };
  struct Seen {
    int robot, index;
  };
  std::map<Cell, std::vector<Seen>> cells;
  std::vector<SyntheticWorld::Pair> pairs;
  for (int robot = 0; robot < static_cast<int>(robots.size()); ++robot)
    for (int i = 0; i < static_cast<int>(robots[robot].size()); ++i) {
      const Eigen::Vector3d p = robots[robot][i].translation();
      const Cell cell = cellOf(p);
      for (int n = 0; n < 27; ++n) {
        const auto found =
            cells.find({cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1});
        if (found == cells.end()) continue;
        for (const Seen& other : found->second)
          if ((other.robot != robot || i - other.index >= least_nodes) &&
              (robots[other.robot][other.index].translation() - p).norm() <= radius)
            pairs.emplace_back(key_node(other.robot, other.index), key_node(robot, i));
      }
      cells[cell].push_back({robot, i});
    }
  return pairs;
}

/** A walk along the streets of a lattice, in space or in the plane. */
inline std::vector<Pose3> latticeWalk(Random& random, int steps, double step_m, int steps_a_block,
                                      int blocks, bool planar) {
  std::vector<Pose3> poses;
  Pose3 pose = Pose3::Identity();
  const double half = 0.5 * step_m * steps_a_block * blocks;
  const auto leaves = [&](const Pose3& at) {
    const Eigen::Vector3d end = at * Eigen::Vector3d(step_m * steps_a_block, 0, 0);
    return end.cwiseAbs().maxCoeff() > half + 1e-6;
  };
  for (int i = 0; i < steps; ++i) {
    if (i % steps_a_block == 0 && (random.uniform(0, 1) < 0.4 || leaves(pose))) {
      Pose3 turned;
      do {
        const Eigen::Vector3d axis = planar || random.uniform(0, 1) < 0.5
                                         ? Eigen::Vector3d::UnitZ()
                                         : Eigen::Vector3d::UnitY();
        const double angle = random.uniform(0, 1) < 0.5 ? M_PI / 2 : -M_PI / 2;
        turned = pose * Eigen::AngleAxisd(angle, axis);
        if (random.uniform(0, 1) < 0.2) turned = turned * Eigen::AngleAxisd(angle, axis);
      } while (leaves(turned));
      pose = normalized(turned);
    }
    poses.push_back(pose);
    pose = pose * Eigen::Translation3d(step_m, 0, 0);
  }
  return poses;
}

/** Streets in space, a loop or more a pose (as in the data sets grid3D and cubicle). */
inline World makeGrid(const SyntheticOptions& options) {
  Random random(options.seed);
  const int blocks = std::max(2, static_cast<int>(0.6 * std::cbrt(options.nodes)));
  SyntheticWorld world(options, false);
  std::vector<std::vector<Pose3>> robots;
  for (int robot = 0; robot < options.robots; ++robot) {
    robots.push_back(latticeWalk(random, options.nodes, 1.0, 2, blocks, false));
    world.addRobot(robot, robots.back());
  }
  return world.finish(meetings(robots, 1.1, 5));
}

/** One long drive through the corridors of a large building, in the plane. */
inline World makeLongDrive(const SyntheticOptions& options) {
  Random random(options.seed);
  const int blocks = std::max(2, static_cast<int>(std::sqrt(options.nodes / 100.0)));
  const std::vector<Pose3> truth = latticeWalk(random, options.nodes, 0.5, 40, blocks, true);
  SyntheticWorld world(options, true);
  world.addRobot(0, truth);
  return world.finish(meetings({truth}, 1.0, 50));
}

/** Robots that drive into a branching tunnel and back, key nodes 2 m apart. Tunnels wind and slope;
 * robot r takes the branch of the k-th fork that bit k of r says. Robots share no start poses. */
inline World makeTunnels(const SyntheticOptions& options) {
  constexpr int kForkNodes = 40;
  Random random(options.seed);
  std::map<std::tuple<int, int>, std::vector<Vector6d>> tunnels;  // by depth and branch
  const auto tunnel = [&](int depth, int branch) -> const std::vector<Vector6d>& {
    const auto [found, is_new] = tunnels.try_emplace({depth, branch});
    if (is_new) {
      double bend = 0, slope = 0;
      for (int i = 0; i < kForkNodes; ++i) {
        bend = 0.8 * bend + random.normal(0.04);
        slope = 0.9 * slope + random.normal(0.005);
        Vector6d step;
        step << 2.0, 0, 0, 0, slope, bend;
        if (i == 0 && depth > 0) step[5] += branch & 1 ? 0.7 : -0.7;
        found->second.push_back(step);
      }
    }
    return found->second;
  };
  SyntheticWorld world(options, false);
  std::vector<std::vector<Pose3>> robots;
  for (int robot = 0; robot < options.robots; ++robot) {
    std::vector<Pose3> way = {Pose3(Eigen::Translation3d(0, 0.3 * robot, 0))};
    const int out = options.nodes / 2;
    for (int depth = 0; static_cast<int>(way.size()) < out; ++depth) {
      const int branch = robot & ((1 << std::min(depth, 3)) - 1);
      for (const Vector6d& step : tunnel(depth, branch))
        if (static_cast<int>(way.size()) < out)
          way.push_back(normalized(way.back() * expSE3(step)));
    }
    for (int i = out - 1; i >= 0 && static_cast<int>(way.size()) < options.nodes; --i)
      way.push_back(way[i] * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()));
    world.addRobot(robot, way);
    robots.push_back(way);
  }
  return world.finish(meetings(robots, 3.0, 10));
}

}  // namespace lamp
