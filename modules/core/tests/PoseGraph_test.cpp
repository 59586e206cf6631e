#include "lamp/core/PoseGraph.h"

#include <gtest/gtest.h>

#include <limits>

namespace lamp {
namespace {

const RobotId kA{0}, kB{1}, kC{2};

Node node(RobotId robot, uint32_t index, bool planar = false) {
  Node n;
  n.id = {robot, index};
  n.planar = planar;
  return n;
}

Edge edge(EdgeType type, KeyNodeId from, KeyNodeId to) {
  Edge e;
  e.type = type;
  e.from = from;
  e.to = to;
  return e;
}

/** Robots of 3, 2 and 1 key nodes, each a chain of odometry edges. */
PoseGraph threeRobots() {
  PoseGraph graph;
  const uint32_t counts[] = {3, 2, 1};
  for (const RobotId robot : {kA, kB, kC})
    for (uint32_t i = 0; i < counts[robot.value]; ++i) {
      graph.addNode(node(robot, i));
      if (i > 0) graph.addEdge(edge(EdgeType::kOdometry, {robot, i - 1}, {robot, i}));
    }
  return graph;
}

EdgeIndex addLoop(PoseGraph& graph, KeyNodeId from, KeyNodeId to,
                  Verdict verdict = Verdict::kInlier) {
  Edge loop = edge(EdgeType::kLoopClosure, from, to);
  loop.verdict = verdict;
  return graph.addEdge(loop);
}

void addPrior(PoseGraph& graph, RobotId robot) {
  graph.addEdge(edge(EdgeType::kPrior, {robot, 0}, {robot, 0}));
}

TEST(PoseGraph, KeepsNodesAndParallelEdgesInOrder) {
  PoseGraph graph = threeRobots();
  const EdgeIndex first = addLoop(graph, {kA, 0}, {kA, 2});
  const EdgeIndex second = addLoop(graph, {kA, 0}, {kA, 2});
  const EdgeIndex reverse = addLoop(graph, {kA, 2}, {kA, 0});
  EXPECT_EQ(first, 3u);
  EXPECT_EQ(second, 4u);
  EXPECT_EQ(reverse, 5u);
  EXPECT_EQ(graph.edges().size(), 6u);
  EXPECT_EQ(graph.edges()[reverse].from, (KeyNodeId{kA, 2}));
  EXPECT_EQ(graph.place({kB, 1}), 4u);
  EXPECT_EQ(graph.node({kB, 1}).id, (KeyNodeId{kB, 1}));
  EXPECT_TRUE(graph.contains({kC, 0}));
  EXPECT_FALSE(graph.contains({kC, 1}));
  EXPECT_THROW(graph.place({kC, 1}), std::out_of_range);
}

TEST(PoseGraph, ListsTheNodesOfARobotByIndex) {
  PoseGraph graph;
  for (const uint32_t index : {2u, 0u, 1u}) graph.addNode(node(kB, index));
  EXPECT_EQ(graph.robotNodes(kB), (std::vector<KeyNodeId>{{kB, 0}, {kB, 1}, {kB, 2}}));
  EXPECT_TRUE(graph.robotNodes(kA).empty());
  EXPECT_EQ(graph.robots(), std::vector<RobotId>{kB});
}

TEST(PoseGraph, RefusesDuplicateNodesAndWrongEnds) {
  PoseGraph graph = threeRobots();
  EXPECT_THROW(graph.addNode(node(kA, 1)), std::logic_error);
  EXPECT_THROW(addLoop(graph, {kA, 0}, {kA, 3}), std::logic_error);
  EXPECT_THROW(addLoop(graph, {kA, 3}, {kA, 0}), std::logic_error);
  EXPECT_THROW(addLoop(graph, {kA, 0}, {kA, 0}), std::logic_error);
  EXPECT_THROW(graph.addEdge(edge(EdgeType::kPrior, {kA, 0}, {kA, 1})), std::logic_error);
  EXPECT_EQ(graph.nodes().size(), 6u);
  EXPECT_EQ(graph.edges().size(), 3u);
}

TEST(PoseGraph, RefusesMeasurementsThatAreNotFinite) {
  PoseGraph graph = threeRobots();
  Edge bad = edge(EdgeType::kLoopClosure, {kA, 0}, {kB, 0});
  bad.from_T_to.translation().y() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(graph.addEdge(bad), std::invalid_argument);
}

TEST(PoseGraph, RefusesWrongInformationButTakesASingularOne) {
  PoseGraph graph = threeRobots();
  Edge e = edge(EdgeType::kLoopClosure, {kA, 0}, {kB, 0});
  e.information(3, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(graph.addEdge(e), std::invalid_argument);
  e.information = Matrix6d::Identity();
  e.information(2, 2) = -1e-3;
  EXPECT_THROW(graph.addEdge(e), std::invalid_argument) << "indefinite";
  e.information = Matrix6d::Identity();
  e.information(0, 1) = 0.1;
  EXPECT_THROW(graph.addEdge(e), std::invalid_argument) << "not symmetric";
  e.information = Matrix6d::Identity();
  e.information(2, 2) = 0;
  EXPECT_NO_THROW(graph.addEdge(e)) << "nothing known about z";
}

TEST(PoseGraph, ComponentsAreSortedLargestFirst) {
  const auto components = threeRobots().components();
  ASSERT_EQ(components.size(), 3u);
  EXPECT_EQ(components[0].nodes, (std::vector<KeyNodeId>{{kA, 0}, {kA, 1}, {kA, 2}}));
  EXPECT_EQ(components[1].robots, std::vector<RobotId>{kB});
  EXPECT_EQ(components[2].robots, std::vector<RobotId>{kC});
}

TEST(PoseGraph, EqualComponentsAreSortedByTheirFirstNode) {
  PoseGraph graph;
  for (const RobotId robot : {kC, kA, kB}) graph.addNode(node(robot, 0));
  const auto components = graph.components();
  ASSERT_EQ(components.size(), 3u);
  for (uint16_t i = 0; i < 3; ++i) EXPECT_EQ(components[i].robots.front(), RobotId{i});
}

TEST(PoseGraph, LoopsJoinComponentsAndRejectedOnesAndPriorsDoNot) {
  PoseGraph graph = threeRobots();
  addPrior(graph, kA);
  addPrior(graph, kB);
  addLoop(graph, {kA, 0}, {kB, 0}, Verdict::kOutlier);
  EXPECT_EQ(graph.components().size(), 3u);
  addLoop(graph, {kB, 1}, {kC, 0}, Verdict::kPending);
  ASSERT_EQ(graph.components().size(), 2u);
  const EdgeIndex loop = addLoop(graph, {kA, 2}, {kC, 0});
  ASSERT_EQ(graph.components().size(), 1u);
  EXPECT_EQ(graph.components()[0].robots, (std::vector<RobotId>{kA, kB, kC}));
  EXPECT_EQ(graph.components()[0].nodes.size(), 6u);
  graph.edges()[loop].verdict = Verdict::kOutlier;
  EXPECT_EQ(graph.components().size(), 2u);
}

TEST(PoseGraph, EmptyGraph) {
  const PoseGraph graph;
  EXPECT_TRUE(graph.components().empty());
  EXPECT_TRUE(graph.robots().empty());
  EXPECT_FALSE(graph.planar());
}

TEST(PoseGraph, RobotsWithStartPosesShareTheWorld) {
  PoseGraph graph = threeRobots();
  EXPECT_TRUE(graph.shareFrame(kA, kA));
  EXPECT_FALSE(graph.shareFrame(kA, kB));
  addPrior(graph, kA);
  EXPECT_FALSE(graph.shareFrame(kA, kB));
  addPrior(graph, kB);
  EXPECT_TRUE(graph.shareFrame(kA, kB));
  EXPECT_FALSE(graph.shareFrame(kA, kC));
}

TEST(PoseGraph, RobotsWithFixedNodesShareTheWorld) {
  PoseGraph graph = threeRobots();
  addPrior(graph, kA);
  Node fixed = node(kC, 1);
  fixed.fixed = true;
  graph.addNode(fixed);
  EXPECT_TRUE(graph.shareFrame(kC, kA));
  EXPECT_FALSE(graph.shareFrame(kC, kB));
}

TEST(PoseGraph, FramesFollowTheVerdicts) {
  PoseGraph graph = threeRobots();
  const EdgeIndex ab = addLoop(graph, {kB, 0}, {kA, 0}), again = addLoop(graph, {kA, 1}, {kB, 1});
  addLoop(graph, {kB, 0}, {kC, 0});
  EXPECT_TRUE(graph.shareFrame(kA, kC));
  graph.edges()[ab].verdict = Verdict::kOutlier;
  EXPECT_TRUE(graph.shareFrame(kA, kC)) << "by the other one";
  graph.edges()[again].verdict = Verdict::kPending;
  EXPECT_FALSE(graph.shareFrame(kA, kC));
  EXPECT_TRUE(graph.shareFrame(kB, kC));
}

TEST(PoseGraph, RobotsShareAFrameThroughLoops) {
  PoseGraph graph = threeRobots();
  addLoop(graph, {kA, 0}, {kC, 0}, Verdict::kOutlier);
  EXPECT_FALSE(graph.shareFrame(kA, kC));
  addLoop(graph, {kA, 0}, {kC, 0}, Verdict::kPending);
  EXPECT_FALSE(graph.shareFrame(kA, kC)) << "the poses do not know of it yet";
  addLoop(graph, {kA, 0}, {kC, 0});
  addLoop(graph, {kC, 0}, {kB, 0});
  EXPECT_TRUE(graph.shareFrame(kB, kA));
}

TEST(PoseGraph, LoopsAndStartPosesTogetherShareAFrame) {
  PoseGraph graph = threeRobots();
  addLoop(graph, {kA, 0}, {kC, 0});
  addPrior(graph, kA);
  addPrior(graph, kB);
  EXPECT_TRUE(graph.shareFrame(kB, kC));
}

TEST(PoseGraph, IsPlanarOnlyIfAllNodesAre) {
  PoseGraph graph;
  graph.addNode(node(kA, 0, true));
  EXPECT_TRUE(graph.planar());
  graph.addNode(node(kB, 0, false));
  EXPECT_FALSE(graph.planar());
}

TEST(PoseGraph, NamesOfTypesAndVerdicts) {
  EXPECT_STREQ(toString(EdgeType::kLoopClosure), "loop_closure");
  EXPECT_STREQ(toString(EdgeType::kPrior), "prior");
  EXPECT_STREQ(toString(Verdict::kPending), "pending");
  EXPECT_STREQ(toString(Verdict::kOutlier), "outlier");
}

TEST(Edge, OnlyLoopClosuresMayBeRejected) {
  EXPECT_TRUE(edge(EdgeType::kLoopClosure, {kA, 0}, {kB, 0}).mayBeRejected());
  EXPECT_FALSE(edge(EdgeType::kOdometry, {kA, 0}, {kA, 1}).mayBeRejected());
  EXPECT_FALSE(edge(EdgeType::kPrior, {kA, 0}, {kA, 0}).mayBeRejected());
}

}  // namespace
}  // namespace lamp
