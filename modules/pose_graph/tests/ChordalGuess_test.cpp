#include <gtest/gtest.h>

#include "TestGraphs.h"
#include "lamp/pose_graph/PlainOptimizers.h"

namespace lamp {
namespace {

/** Exact measurements; estimates far off. */
World exactWorld(bool planar) {
  WorldOptions options;
  options.planar = planar;
  World world = makeWorld(options);
  for (Edge& edge : world.graph.edges())
    if (edge.type != EdgeType::kPrior)
      edge.from_T_to = world.truth[world.graph.place(edge.from)].inverse() *
                       world.truth[world.graph.place(edge.to)];
  return world;
}

TEST(ChordalGuess, IsExactForExactMeasurements) {
  for (const bool planar : {false, true}) {
    const World world = exactWorld(planar);
    const std::vector<Pose3> guess = chordalGuess(world.graph);
    for (size_t i = 0; i < guess.size(); ++i)
      EXPECT_TRUE(guess[i].isApprox(world.truth[i], 1e-6)) << i;
  }
}

TEST(ChordalGuess, LeadsWhereABadOdometryDoesNot) {
  WorldOptions options;
  options.robots = 1;
  options.loops = 300;
  World world = makeWorld(options);
  Random random(3);
  for (Edge& edge : world.graph.edges())
    if (edge.type == EdgeType::kOdometry) {
      edge.from_T_to = edge.from_T_to * expSE3(random.tangent(0.3, 0.5));
      edge.information = informationOf(0.3, 0.5);
    }
  PlainOptions options_of_start;
  options_of_start.start = "odometry";
  const OptimizationResult odometry = Lm(options_of_start).optimize(world.graph);
  options_of_start.start = "chordal";
  const OptimizationResult chordal = Lm(options_of_start).optimize(world.graph);
  EXPECT_LT(chordal.report.initial_cost, 0.1 * odometry.report.initial_cost);
  EXPECT_LE(chordal.report.final_cost, odometry.report.final_cost * (1 + 1e-6));
  EXPECT_LT(meanDistance(chordal.world_T_base, world.truth), 0.5);
}

TEST(ChordalGuess, LoneNodesAndOddComponentsStay) {
  PoseGraph graph;
  EXPECT_TRUE(chordalGuess(graph).empty());
  for (int i = 0; i < 2; ++i) {
    Node node;
    node.id = key_node(i, 0);
    node.world_T_base = planarPose(3.0 * i, 1, 2);
    graph.addNode(node);
  }
  const std::vector<Pose3> guess = chordalGuess(graph);
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(guess[i].isApprox(planarPose(3.0 * i, 1, 2), 1e-12));
}

TEST(SpanningTreeGuess, LoopsJoinWhatOdometryDoesNot) {
  WorldOptions options;
  options.priors = false;
  World world = makeWorld(options);
  world.graph.node(key_node(1, 0)).world_T_base = planarPose(500, 0, 1);
  EXPECT_LT(meanDistance(spanningTreeGuess(world.graph), world.truth), 5);
}

}  // namespace
}  // namespace lamp
