#include "lamp/loop_candidates/Neighbors.h"

#include <gtest/gtest.h>

namespace lamp {
namespace {

PoseGraph line() {
  PoseGraph graph;
  for (const RobotId robot : {RobotId{0}, RobotId{1}})
    for (uint32_t i = 0; i < 6; ++i) {
      Node node;
      node.id = {robot, i};
      node.world_T_base = planarPose(0.5 * i, 0, 0);
      graph.addNode(node);
    }
  return graph;
}

std::vector<KeyNodeId> older(const PoseGraph& graph, KeyNodeId current) {
  std::vector<KeyNodeId> ids;
  for (const LoopClosureCandidate& c : Neighbors().propose(graph, current)) {
    EXPECT_EQ(c.to, current);
    ids.push_back(c.from);
  }
  return ids;
}

TEST(Neighbors, AreThoseOfTheSameRobotJustBefore) {
  const RobotId robot{1};
  const PoseGraph graph = line();
  EXPECT_EQ(older(graph, {robot, 5}), (std::vector<KeyNodeId>{{robot, 4}, {robot, 3}}));
  EXPECT_EQ(older(graph, {robot, 1}), (std::vector<KeyNodeId>{{robot, 0}}));
  EXPECT_TRUE(older(graph, {robot, 0}).empty());
}

TEST(Neighbors, NeedNoSearchBeyondOdometry) {
  for (const LoopClosureCandidate& c : Neighbors().propose(line(), {RobotId{0}, 5}))
    EXPECT_TRUE(c.certain_guess);
}

}  // namespace
}  // namespace lamp
