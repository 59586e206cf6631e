#include "RunWarnings.h"

#include <gtest/gtest.h>

namespace lamp {
namespace {

constexpr RobotId kA{0}, kB{1};

void addRobot(PoseGraph& graph, RobotId robot, bool planar, bool start_pose) {
  Node node;
  node.id = {robot, 0};
  node.planar = planar;
  graph.addNode(node);
  if (!start_pose) return;
  Edge prior;
  prior.type = EdgeType::kPrior;
  prior.from = prior.to = node.id;
  graph.addEdge(prior);
}

TEST(RunWarnings, PlanarRobotsNeedStartPoses) {
  PoseGraph graph;
  EXPECT_FALSE(planarRobotsAreUnrelated(graph));
  addRobot(graph, kA, true, true);
  EXPECT_FALSE(planarRobotsAreUnrelated(graph));

  PoseGraph one_start = graph, two_starts = graph, in_space = graph;
  addRobot(one_start, kB, true, false);
  EXPECT_TRUE(planarRobotsAreUnrelated(one_start));
  addRobot(two_starts, kB, true, true);
  EXPECT_FALSE(planarRobotsAreUnrelated(two_starts));
  addRobot(in_space, kB, false, false);
  EXPECT_FALSE(planarRobotsAreUnrelated(in_space)) << "scans in space need no guess";
}

}  // namespace
}  // namespace lamp
