#include <gtest/gtest.h>

#include "TestGraphs.h"
#include "lamp/pose_graph/Gnc.h"
#include "lamp/pose_graph/PlainOptimizers.h"

namespace lamp {
namespace {

/** Laps of a circle, of whose turns odometry measures a share, with errors. Each step is within its
 * stated errors, but where they all lead is far from the truth. */
World laps(int count, bool planar, double measured_share, double yaw_sigma, unsigned seed) {
  constexpr int kLap = 100;
  World world;
  Random random(seed);
  const double turn = 2 * M_PI / kLap;
  Pose3 pose = Pose3::Identity();
  for (int i = 0; i < count * kLap; ++i) {
    Node node;
    node.id = key_node(0, i);
    node.planar = planar;
    world.graph.addNode(node);
    world.truth.push_back(pose);
    pose = normalized(pose * planarPose(1, 0, turn));
    if (i == 0) continue;
    world.graph.addEdge(makeEdge(EdgeType::kOdometry, key_node(0, i - 1), node.id,

                                 planarPose(1 + random.normal(0.02), random.normal(0.02),
                                            measured_share * turn + random.normal(yaw_sigma)),
                                 informationOf(0.02, yaw_sigma)));
  }
  for (int i = kLap; i < count * kLap; i += 10)
    world.graph.addEdge(makeEdge(EdgeType::kLoopClosure, key_node(0, i - kLap), key_node(0, i),
                                 Pose3::Identity(), informationOf(0.05, 0.01)));
  return world;
}

TEST(FarStarts, APieceThatTurnsAsAWholeTakesFewIterations) {
  for (const bool planar : {true, false}) {
    PlainOptions options;
    options.start = "odometry";
    const OptimizationResult result = Lm(options).optimize(laps(3, planar, 0.6, 0.02, 1).graph);
    EXPECT_LE(result.report.iterations, 10);
    EXPECT_EQ(result.report.termination.rfind("converged", 0), 0u) << result.report.termination;
  }
}

TEST(FarStarts, GncLeavesAWrongMinimumOfOdometry) {
  for (const unsigned seed : {1, 2, 3}) {
    const World world = laps(3, true, 1.0, 0.2, seed);
    PlainOptions options;
    options.start = "odometry";
    const double by_odometry = Lm(options).optimize(world.graph).report.final_cost;
    options.start = "chordal";
    const double least = Lm(options).optimize(world.graph).report.final_cost;
    ASSERT_GT(by_odometry, 5 * least) << "the world is too easy";
    const OptimizationResult result = Gnc().optimize(world.graph);
    EXPECT_LE(result.report.final_cost, 1.001 * least);
    for (const LoopVerdict& loop : result.loops) EXPECT_EQ(loop.verdict, Verdict::kInlier);
  }
}

}  // namespace
}  // namespace lamp
