#include "lamp/loop_candidates/GlobalSearch.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace lamp {
namespace {

constexpr RobotId kA{0}, kB{1};

void addNodes(PoseGraph& graph, RobotId robot, uint32_t count, bool with_prior) {
  for (uint32_t i = 0; i < count; ++i) {
    Node node;
    node.id = {robot, i};
    graph.addNode(node);
  }
  if (!with_prior) return;
  Edge prior;
  prior.type = EdgeType::kPrior;
  prior.from = prior.to = {robot, 0};
  graph.addEdge(prior);
}

TEST(GlobalSearch, TriesTheOtherRobotsWholeWay) {
  PoseGraph graph;
  addNodes(graph, kA, 12, true);
  addNodes(graph, kB, 20, false);
  GlobalSearch search;
  search.options.max_per_robot = 3;
  std::set<uint32_t> tried;
  for (uint32_t i = 0; i < 20; ++i) {
    const auto candidates = search.propose(graph, {kB, i});
    std::set<KeyNodeId> distinct;
    for (const auto& candidate : candidates) {
      EXPECT_EQ(candidate.to, (KeyNodeId{kB, i}));
      EXPECT_EQ(candidate.from.robot, kA);
      distinct.insert(candidate.from);
      tried.insert(candidate.from.index);
    }
    EXPECT_EQ(distinct.size(), 3u);
  }
  EXPECT_EQ(tried.size(), 12u);
}

TEST(GlobalSearch, ManyRobotsAreTriedInTurn) {
  constexpr uint16_t kRobots = 9;
  PoseGraph graph;
  for (uint16_t robot = 0; robot < kRobots; ++robot) addNodes(graph, {robot}, 12, false);
  GlobalSearch search;
  search.options.max_other_robots = 3;
  search.options.max_per_robot = 2;
  std::set<RobotId> tried;
  for (uint32_t i = 0; i < 3; ++i) {
    const auto candidates = search.propose(graph, {RobotId{8}, i});
    EXPECT_EQ(candidates.size(), 6u);
    for (const auto& candidate : candidates) tried.insert(candidate.from.robot);
  }
  EXPECT_EQ(tried.size(), kRobots - 1u);
}

TEST(GlobalSearch, TheOlderKeyNodeComesFirst) {
  PoseGraph graph;
  addNodes(graph, kA, 2, false);
  addNodes(graph, kB, 2, false);
  for (const auto& [current, other] : {std::pair(kA, kB), std::pair(kB, kA)}) {
    const auto candidates = GlobalSearch().propose(graph, {current, 1});
    ASSERT_EQ(candidates.size(), 2u) << "both key nodes of the other robot";
    for (const auto& candidate : candidates) {
      EXPECT_EQ(candidate.from.robot, kA);
      EXPECT_EQ(candidate.to.robot, kB);
    }
  }
}

TEST(GlobalSearch, HasNothingToDoWhereAFrameIsShared) {
  PoseGraph graph;
  addNodes(graph, kA, 12, true);
  EXPECT_TRUE(GlobalSearch().propose(graph, {kA, 3}).empty()) << "a robot alone";
  addNodes(graph, kB, 20, true);
  EXPECT_TRUE(GlobalSearch().propose(graph, {kB, 3}).empty()) << "start poses of both";
}

}  // namespace
}  // namespace lamp
