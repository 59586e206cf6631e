#include "lamp/loop_candidates/RadiusGenerators.h"

#include <gtest/gtest.h>

#include <memory>

namespace lamp {
namespace {

constexpr RobotId kA{0}, kB{1};

/** Key nodes of one robot, 2 m apart along x, with an optional start prior. */
void addLine(PoseGraph& graph, RobotId robot, uint32_t count, const Eigen::Vector3d& start,
             bool with_prior) {
  for (uint32_t i = 0; i < count; ++i) {
    Node node;
    node.id = {robot, i};
    node.world_T_base.translation() = start + Eigen::Vector3d(2.0 * i, 0, 0);
    graph.addNode(node);
    if (i == 0 && with_prior) {
      Edge prior;
      prior.type = EdgeType::kPrior;
      prior.from = prior.to = node.id;
      prior.from_T_to = node.world_T_base;
      graph.addEdge(prior);
    }
  }
}

template <class Generator>
std::shared_ptr<Generator> make() {
  registerAllClasses_lamp_loop_candidates();
  auto generator = std::make_shared<Generator>();
  generator->setLoggerName("test");
  return generator;
}

std::vector<uint32_t> olderIndices(const std::vector<LoopClosureCandidate>& candidates) {
  std::vector<uint32_t> indices;
  for (const auto& c : candidates) indices.push_back(c.from.index);
  return indices;
}

TEST(FixedRadius, TakesTheNearestBeyondTheIndexGap) {
  PoseGraph graph;
  addLine(graph, kA, 30, {0, 0, 0}, false);
  auto generator = make<FixedRadius>();
  generator->options.radius_m = 25;
  generator->options.min_index_gap = 10;
  generator->options.max_per_robot = 2;
  const auto candidates = generator->propose(graph, {kA, 29});
  EXPECT_EQ(olderIndices(candidates), (std::vector<uint32_t>{19, 18}));
  EXPECT_EQ(candidates[0].to, (KeyNodeId{kA, 29}));
  EXPECT_EQ(candidates[0].generator, "test");
}

TEST(FixedRadius, OfManyRobotsTheNearestCount) {
  constexpr uint16_t kRobots = 20;
  PoseGraph graph;
  for (uint16_t robot = 0; robot < kRobots; ++robot)
    addLine(graph, {robot}, 30, {0, 0.1 * ((7 * robot) % kRobots), 0}, true);
  auto generator = make<FixedRadius>();
  generator->options.max_per_robot = 2;
  generator->options.max_other_robots = 3;
  const auto candidates = generator->propose(graph, {RobotId{0}, 29});
  std::multiset<uint16_t> robots;
  for (const auto& candidate : candidates) robots.insert(candidate.to.robot.value);
  // 7 * robot is 1, 2 and 3 modulo 20 for these.
  EXPECT_EQ(robots, (std::multiset<uint16_t>{3, 3, 6, 6, 9, 9}));
}

TEST(FixedRadius, AnOlderNodeFindsNewerOnes) {
  PoseGraph graph;
  addLine(graph, kA, 30, {0, 0, 0}, false);
  auto generator = make<FixedRadius>();
  generator->options.radius_m = 20.5;
  const auto candidates = generator->propose(graph, {kA, 0});
  ASSERT_EQ(candidates.size(), 1u);
  EXPECT_EQ(candidates[0].from, (KeyNodeId{kA, 0}));
  EXPECT_EQ(candidates[0].to, (KeyNodeId{kA, 10}));
}

TEST(AdaptiveRadius, GrowsWithTheWayWithinARobot) {
  // Paper: d_max = alpha |n_curr - n_cand|; nodes 2 m apart are within 0.2 m a node of none.
  PoseGraph graph;
  addLine(graph, kA, 101, {0, 0, 0}, false);
  auto generator = make<AdaptiveRadius>();
  generator->options.min_radius_m = 0.1;
  EXPECT_TRUE(generator->propose(graph, {kA, 100}).empty());
  generator->options.alpha_m = 2.01;
  generator->options.max_radius_m = 1000;
  generator->options.max_per_robot = 1000;
  EXPECT_EQ(generator->propose(graph, {kA, 100}).size(), 91u);
  generator->options.max_radius_m = 41;
  EXPECT_EQ(generator->propose(graph, {kA, 100}).size(), 11u);
}

TEST(AdaptiveRadius, GrowsWithTheCurrentIndexBetweenRobots) {
  PoseGraph graph;
  addLine(graph, kA, 51, {0, 0, 0}, true);
  addLine(graph, kB, 51, {0, 8, 0}, true);
  auto generator = make<AdaptiveRadius>();
  generator->options.between_robots_min_radius_m = 1;
  generator->options.min_radius_m = 0.1;
  generator->options.max_radius_m = 0.1;
  EXPECT_TRUE(generator->propose(graph, {kB, 30}).empty());     // 0.2 m * 30 < 8 m
  const auto candidates = generator->propose(graph, {kB, 42});  // 0.2 m * 42 > 8 m
  ASSERT_EQ(candidates.size(), 3u);
  EXPECT_EQ(candidates[0].from, (KeyNodeId{kA, 42}));
}

TEST(RadiusGenerators, RobotsWithoutACommonFrameAreNotCompared) {
  PoseGraph graph;
  addLine(graph, kA, 20, {0, 0, 0}, true);
  addLine(graph, kB, 20, {0, 1, 0}, false);
  EXPECT_TRUE(make<FixedRadius>()->propose(graph, {kB, 3}).empty());
}

TEST(RadiusGenerators, ALoneNodeHasNoCandidates) {
  PoseGraph graph;
  addLine(graph, kA, 1, {0, 0, 0}, false);
  EXPECT_TRUE(make<AdaptiveRadius>()->propose(graph, {kA, 0}).empty());
}

}  // namespace
}  // namespace lamp
