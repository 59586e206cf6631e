#include "WorldFrame.h"

#include <gtest/gtest.h>

#include "TestTeam.h"

namespace lamp {
namespace {

using namespace test;
using Eigen::Vector3d;

Vector3d originFrom(const std::string& ini) {
  return localOrigin(configFrom(ini));
}

TEST(WorldFrame, OriginIsAtWholeKilometresInTheMidstOfTheStartPoses) {
  EXPECT_EQ(originFrom("[robot.A]\nstart_pose = [431200.25 5412345.5 312 6 -1 -0.3]\n"
                       "[robot.B]\nstart_pose = [431900 5413600 1200 0 0 0]\n[robot.C]\n"),
            Vector3d(431000, 5412000, 0));
  EXPECT_EQ(originFrom("[robot.A]\nstart_pose = [-5200 999 -1001 0 0 0]\n"),
            Vector3d(-5000, 0, -1000));
}

TEST(WorldFrame, OriginStaysWithinAKilometreAndWithoutStartPoses) {
  EXPECT_EQ(originFrom("[robot.A]\nstart_pose = [999.9 -999.9 3 0 0 0]\n"), Vector3d(0, 0, 0));
  EXPECT_EQ(originFrom("[robot.A]\n"), Vector3d(0, 0, 0));
}

TEST(WorldFrame, KnownBeaconsCountWhereNoStartPoseIsKnown) {
  const std::string beacon = "[beacon.east]\nid = 1\nposition = [7000 0 0]\n[beacon.any]\nid = 2\n";
  EXPECT_EQ(originFrom(beacon), Vector3d(7000, 0, 0));
  EXPECT_EQ(originFrom(beacon + "[robot.A]\nstart_pose = [3000 0 0 0 0 0]\n"),
            Vector3d(3000, 0, 0));
}

TEST(WorldFrame, SoDoesTheGate) {
  const std::string gate = "[gate]\nplates = [7000 1 1 7000 -1 1 7000 0 2]\n";
  EXPECT_EQ(originFrom(gate), Vector3d(7000, 0, 0));
}

TEST(WorldFrame, PlacesMoveIntoTheLocalFrame) {
  const SlamConfig world = configFrom(
      "[robot.A]\nstart_pose = [431200.25 5412345.5 312 6 -1 -0.3]\n[robot.B]\n"
      "[beacon.east]\nid = 1\nposition = [431300 5412000 0]\n[beacon.any]\nid = 2\n"
      "[gate]\nplates = [431200 5412300 310 431200 5412303 311 431200 5412301 312]\n");
  const SlamConfig local = inLocalFrame(world, {431000, 5412000, 0});
  EXPECT_EQ(local.robots[0].start_pose, (std::vector<double>{200.25, 345.5, 312, 6, -1, -0.3}));
  EXPECT_TRUE(local.robots[1].start_pose.empty());
  EXPECT_EQ(local.beacons[0].position, (std::vector<double>{300, 0, 0}));
  EXPECT_TRUE(local.beacons[1].position.empty());
  EXPECT_EQ(local.gate.plates, (std::vector<double>{200, 300, 310, 200, 303, 311, 200, 301, 312}));
}

/** One key node a robot; the first has a start pose, the second sees a known beacon and an unknown
 * one, the third is on its own. */
PoseGraph threeRobots() {
  PoseGraph graph;
  for (uint16_t robot = 0; robot < 3; ++robot) {
    Node node;
    node.id.robot = {robot};
    node.world_T_base = planarPose(robot, 2, 0.5);
    graph.addNode(node);
  }
  Edge prior;
  prior.type = EdgeType::kPrior;
  prior.from_T_to = planarPose(0, 2, 0.5);
  graph.addEdge(prior);
  for (const bool known : {true, false}) {
    Edge range;
    range.type = EdgeType::kRange;
    range.from = range.to = {RobotId{1}, 0};
    range.landmark =
        graph.addLandmark({known ? "known" : "unknown", Vector3d(5, 6, 7), known, true});
    graph.addEdge(range);
  }
  return graph;
}

TEST(WorldFrame, WhatIsTiedToTheWorldMovesAndTheRestKeepsItsOwnFrame) {
  const Vector3d origin(431000, 5412000, 1000);
  const PoseGraph local = threeRobots(), world = inWorldFrame(local, origin);
  for (uint16_t robot : {0, 1, 2}) {
    const Vector3d expected = robot < 2 ? origin : Vector3d(0, 0, 0);
    const KeyNodeId id{RobotId{robot}, 0};
    EXPECT_EQ(world.node(id).world_T_base.translation(),
              local.node(id).world_T_base.translation() + expected);
    EXPECT_EQ(world.node(id).world_T_base.linear(), local.node(id).world_T_base.linear());
    EXPECT_EQ(originOf({{id}, {id.robot}}, local, origin), expected);
  }
  EXPECT_EQ(world.edges()[0].from_T_to.translation(), origin + Vector3d(0, 2, 0));
  for (const Landmark& landmark : world.landmarks())
    EXPECT_EQ(landmark.world_p, origin + Vector3d(5, 6, 7)) << landmark.name;
}

}  // namespace
}  // namespace lamp
