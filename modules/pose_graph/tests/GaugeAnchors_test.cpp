#include "solver/GaugeAnchors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TestGraphs.h"

namespace lamp {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const Matrix6d kInformation = informationOf(0.1, 0.01);

/** Two robots of two key nodes, added last first, and a loop (edge 2) between them. */
PoseGraph twoRobots() {
  PoseGraph graph;
  for (const KeyNodeId id : {key_node(1, 1), key_node(1, 0), key_node(0, 1), key_node(0, 0)}) {
    Node node;
    node.id = id;
    graph.addNode(node);
  }
  for (int robot : {0, 1})
    graph.addEdge(makeEdge(EdgeType::kOdometry, key_node(robot, 0), key_node(robot, 1),
                           Pose3::Identity(), kInformation));
  graph.addEdge(makeEdge(EdgeType::kLoopClosure, key_node(0, 1), key_node(1, 1), Pose3::Identity(),
                         kInformation));
  return graph;
}

void addPrior(PoseGraph& graph, KeyNodeId id) {
  graph.addEdge(makeEdge(EdgeType::kPrior, id, id, Pose3::Identity(), kInformation));
}

TEST(GaugeAnchors, FirstKeyNodeOfAJoinedTeam) {
  EXPECT_THAT(gaugeAnchors(twoRobots(), {1, 1, 1}), ElementsAre(3));
}

TEST(GaugeAnchors, DroppedLoopLeavesTwoComponents) {
  EXPECT_THAT(gaugeAnchors(twoRobots(), {1, 1, 0}), ElementsAre(1, 3));
}

TEST(GaugeAnchors, FixedNodeHoldsItsComponentOnly) {
  PoseGraph graph = twoRobots();
  Node fixed;
  fixed.id = key_node(1, 2);
  fixed.fixed = true;
  graph.addNode(fixed);
  graph.addEdge(makeEdge(EdgeType::kOdometry, key_node(1, 1), key_node(1, 2), Pose3::Identity(),
                         kInformation));
  EXPECT_THAT(gaugeAnchors(graph, {1, 1, 1, 1}), IsEmpty());
  EXPECT_THAT(gaugeAnchors(graph, {1, 1, 0, 1}), ElementsAre(3));
}

TEST(GaugeAnchors, PriorHoldsItsComponentOnly) {
  PoseGraph graph = twoRobots();
  addPrior(graph, key_node(1, 1));
  EXPECT_THAT(gaugeAnchors(graph, {1, 1, 1, 1}), IsEmpty());
  EXPECT_THAT(gaugeAnchors(graph, {1, 1, 0, 1}), ElementsAre(3));
}

TEST(GaugeAnchors, PriorsDoNotJoin) {
  PoseGraph graph = twoRobots();
  addPrior(graph, key_node(0, 0));
  addPrior(graph, key_node(1, 0));
  EXPECT_THAT(gaugeAnchors(graph, {1, 1, 0, 1, 1}), IsEmpty());
}

TEST(GaugeAnchors, LoneNodesAndNone) {
  EXPECT_THAT(gaugeAnchors(PoseGraph(), {}), IsEmpty());
  EXPECT_THAT(gaugeAnchors(twoRobots(), {0, 0, 0}), ElementsAre(0, 1, 2, 3));
}

}  // namespace
}  // namespace lamp
