#include "lamp/pose_graph/RobotFrames.h"

#include <gtest/gtest.h>

#include "TestGraphs.h"
#include "lamp/pose_graph/BackEnd.h"
#include "lamp/pose_graph/Gnc.h"
#include "lamp/pose_graph/InitialGuess.h"
#include "rejection/OdometryChains.h"

namespace lamp {
namespace {

/** Robots of which only the first has a start pose; the estimates of the others are far off. */
World strangers(int loops, int outliers, bool planar = false) {
  WorldOptions options;
  options.priors = false;
  options.loops = loops;
  options.outliers = outliers;
  options.planar = planar;
  World world = makeWorld(options);
  for (const KeyNodeId id : world.graph.robotNodes(key_node(1, 0).robot))
    world.graph.node(id).world_T_base = planarPose(-300, 70, 2) * world.graph.node(id).world_T_base;
  return world;
}

BackEnd backEnd(int min_agreeing) {
  BackEnd back_end;
  back_end.rejections = {std::make_shared<RobotFrames>(RobotFramesOptions{min_agreeing})};
  back_end.optimizer = std::make_shared<Gnc>();
  return back_end;
}

size_t keptBetween(const PoseGraph& graph, const OptimizationResult& result) {
  size_t count = 0;
  for (const LoopVerdict& loop : result.loops)
    count += loop.verdict == Verdict::kInlier && graph.edges()[loop.edge].betweenRobots();
  return count;
}

TEST(RobotFrames, AgreeingLoopsJoinStrangersAmongFalseOnes) {
  for (const bool planar : {false, true}) {
    const World world = strangers(60, 60, planar);
    const OptimizationResult result = backEnd(5).optimize(world.graph);
    ASSERT_EQ(result.report.frames.size(), 1u);
    const FrameAgreement& agreement = result.report.frames[0];
    EXPECT_TRUE(agreement.joined);
    EXPECT_GE(agreement.agreeing, 5u);
    EXPECT_LT(agreement.agreeing, agreement.loops);
    for (const LoopVerdict& loop : result.loops)
      EXPECT_EQ(loop.verdict == Verdict::kInlier, world.true_edge[loop.edge]) << loop.edge;
    EXPECT_LT(meanDistance(result.world_T_base, world.truth), 0.5);
  }
}

TEST(RobotFrames, TooFewLeaveTheMapsApartAndSaySo) {
  const World world = strangers(60, 0);
  const OptimizationResult result = backEnd(1000).optimize(world.graph);
  ASSERT_EQ(result.report.frames.size(), 1u);
  EXPECT_FALSE(result.report.frames[0].joined);
  EXPECT_EQ(result.report.frames[0].needed, 1000u);
  EXPECT_EQ(keptBetween(world.graph, result), 0u);
}

TEST(RobotFrames, FalseLoopsAloneDoNotJoin) {
  const World world = strangers(0, 100);
  const OptimizationResult result = backEnd(5).optimize(world.graph);
  ASSERT_EQ(result.report.frames.size(), 1u);
  EXPECT_FALSE(result.report.frames[0].joined) << result.report.frames[0].agreeing;
  EXPECT_EQ(keptBetween(world.graph, result), 0u);
}

TEST(RobotFrames, LoopsOfOneKeyNodeCountOnce) {
  World world = strangers(0, 0);
  for (int i = 0; i < 10; ++i) {
    const KeyNodeId from = key_node(0, 3), to = key_node(1, 10 + i);
    world.graph.addEdge(makeEdge(
        EdgeType::kLoopClosure, from, to,
        world.truth[world.graph.place(from)].inverse() * world.truth[world.graph.place(to)],
        informationOf(0.05, 0.01)));
  }
  const OptimizationResult result = backEnd(2).optimize(world.graph);
  ASSERT_EQ(result.report.frames.size(), 1u);
  EXPECT_EQ(result.report.frames[0].agreeing, 1u);
  EXPECT_FALSE(result.report.frames[0].joined);
}

TEST(RobotFrames, StartPosesNeedNoAgreement) {
  WorldOptions options;
  options.loops = 3;
  const World world = makeWorld(options);
  const OptimizationResult result = backEnd(1000).optimize(world.graph);
  EXPECT_TRUE(result.report.frames.empty());
  for (const LoopVerdict& loop : result.loops) EXPECT_EQ(loop.verdict, Verdict::kInlier);
}

/** One robot whose odometry has gaps, with few loops between some of its pieces. */
World piecesOfOneRobot(int loops) {
  WorldOptions options;
  options.robots = 1;
  options.loops = loops;
  World world = makeWorld(options), result;
  for (const Node& node : world.graph.nodes()) result.graph.addNode(node);
  for (const Edge& edge : world.graph.edges())
    if (edge.type != EdgeType::kOdometry || edge.to.index % 30 != 0) result.graph.addEdge(edge);
  result.truth = world.truth;
  return result;
}

TEST(RobotFrames, PiecesOfOneRobotAreNoStrangers) {
  const World world = piecesOfOneRobot(6);
  ASSERT_GT(OdometryChains(world.graph).size(), 2);
  const OptimizationResult result = backEnd(5).optimize(world.graph);
  EXPECT_TRUE(result.report.frames.empty());
  for (const LoopVerdict& loop : result.loops) EXPECT_EQ(loop.verdict, Verdict::kInlier);
  EXPECT_LT(meanDistance(result.world_T_base, world.truth), 0.5);
}

TEST(InitialGuess, LoopsPlaceARobotWhoseStartIsBadlyKnown) {
  World world = strangers(60, 40);
  const KeyNodeId start = key_node(1, 0);
  const Pose3 truth = world.truth[world.graph.place(start)];
  const Pose3 wrong = truth * planarPose(15, -10, 0.6);
  world.graph.addEdge(makeEdge(EdgeType::kPrior, start, start, wrong, informationOf(20, 1)));
  EXPECT_LT(meanDistance(initialGuess(world.graph), world.truth), 2);
  EXPECT_LT(meanDistance(Gnc().optimize(world.graph).world_T_base, world.truth), 0.5);
}

TEST(InitialGuess, LoopsDoNotMoveARobotWhoseStartTheyContradict) {
  World world = strangers(0, 0);
  const KeyNodeId start = key_node(1, 0);
  const Pose3 truth = world.truth[world.graph.place(start)];
  world.graph.addEdge(makeEdge(EdgeType::kPrior, start, start, truth, informationOf(0.1, 0.01)));
  const double before = meanDistance(initialGuess(world.graph), world.truth);
  for (int i = 0; i < 10; ++i)
    world.graph.addEdge(makeEdge(EdgeType::kLoopClosure, key_node(0, i), key_node(1, i),
                                 planarPose(40, 0, 1), informationOf(0.01, 0.001)));
  EXPECT_EQ(meanDistance(initialGuess(world.graph), world.truth), before);
}

}  // namespace
}  // namespace lamp
