#include "lamp/pose_graph/OdometryGate.h"

#include <gtest/gtest.h>

#include <limits>

#include "TestGraphs.h"

namespace lamp {
namespace {

struct Passed {
  int right = 0, wrong = 0;
};

Passed passed(const World& world, OdometryGateOptions options = {}) {
  const std::vector<bool> admitted =
      OdometryGate(options).reject(world.graph, everything(world.graph)).admitted;
  Passed result;
  for (size_t e = 0; e < admitted.size(); ++e) {
    if (!world.graph.edges()[e].mayBeRejected()) {
      EXPECT_TRUE(admitted[e]);
      continue;
    }
    if (admitted[e]) ++(world.true_edge[e] ? result.right : result.wrong);
  }
  return result;
}

class Gate : public testing::TestWithParam<bool> {
 protected:
  static WorldOptions options() {
    WorldOptions options;
    options.planar = GetParam();
    options.loops = 60;
    options.outliers = 240;
    return options;
  }
};
INSTANTIATE_TEST_SUITE_P(All, Gate, testing::Bool());

TEST_P(Gate, LetsTrueLoopsPassAndFewOthers) {
  const Passed loops = passed(makeWorld(options()));
  EXPECT_GE(loops.right, 59);
  EXPECT_LT(loops.wrong, 60);
}

TEST_P(Gate, OdometryThatIsWorseThanItSaysLosesNoLoop) {
  World world = makeWorld(options());
  for (Edge& edge : world.graph.edges())
    if (edge.type == EdgeType::kOdometry) edge.information *= 10;
  EXPECT_GE(passed(world).right, 58);
  OdometryGateOptions strict;
  strict.max_scale = 1;
  EXPECT_LT(passed(world, strict).right, 50);
}

TEST_P(Gate, TellsTheScaleOnlyIfManyLoopsAskForIt) {
  const auto scaleOf = [](const World& world) {
    return OdometryGate().reject(world.graph, everything(world.graph)).odometry_scale;
  };
  World world = makeWorld(options());
  EXPECT_EQ(scaleOf(world), 1.0);
  for (Edge& edge : world.graph.edges())
    if (edge.type == EdgeType::kOdometry) edge.information *= 100;
  EXPECT_GE(scaleOf(world), 16.0);

  WorldOptions few = options();
  few.loops = 0;
  few.outliers = 3;
  EXPECT_EQ(scaleOf(makeWorld(few)), 1.0) << "a false loop is no witness";
}

TEST_P(Gate, TellsHowManyLoopsMayBeFalse) {
  const auto falseLoops = [](const World& world) {
    return OdometryGate().reject(world.graph, everything(world.graph)).false_loops;
  };
  EXPECT_NEAR(falseLoops(makeWorld(options())), 240, 60);

  WorldOptions few = options();
  few.outliers = 0;
  EXPECT_LT(falseLoops(makeWorld(few)), 1) << "odometry could have contradicted them";
  World vague = makeWorld(few);
  for (Edge& edge : vague.graph.edges())
    if (edge.type == EdgeType::kOdometry) edge.information *= 1e-8;
  EXPECT_GT(falseLoops(vague), 1) << "odometry could not";

  few.loops = 1;
  World lone = makeWorld(few);
  for (Edge& edge : lone.graph.edges())
    if (edge.type == EdgeType::kOdometry) edge.information *= 1e-8;
  EXPECT_LE(falseLoops(lone), 0.05);

  few.loops = 0;
  EXPECT_EQ(falseLoops(makeWorld(few)), std::numeric_limits<double>::infinity())
      << "nothing is known of loops that odometry says nothing of";
}

TEST_P(Gate, UnrelatedRobotsPass) {
  WorldOptions apart = options();
  apart.priors = false;
  const World world = makeWorld(apart);
  const std::vector<bool> admitted =
      OdometryGate().reject(world.graph, everything(world.graph)).admitted;
  for (size_t e = 0; e < admitted.size(); ++e)
    EXPECT_TRUE(admitted[e] || !world.graph.edges()[e].betweenRobots());
}

TEST(OdometryGate, DirectionsThatALoopDoesNotKnowAreNotJudged) {
  WorldOptions options;
  options.robots = 1;
  options.loops = 0;
  World world = makeWorld(options);
  Edge loop = makeEdge(EdgeType::kLoopClosure, key_node(0, 0), key_node(0, 30),
                       world.truth[0].inverse() * world.truth[30], informationOf(0.05, 0.01));
  loop.from_T_to.translation() += loop.from_T_to.linear() * Eigen::Vector3d(20, 0, 0);
  for (const bool blind : {false, true}) {
    if (blind) {
      loop.information.row(0).setZero();
      loop.information.col(0).setZero();
    }
    World with = world;
    with.graph.addEdge(loop);
    OdometryGateOptions strict;
    strict.max_scale = 1;
    const Admission gated = OdometryGate(strict).reject(with.graph, everything(with.graph));
    EXPECT_EQ(gated.admitted.back(), blind);
  }
}

TEST(OdometryGate, NoLoopsNoNodes) {
  EXPECT_TRUE(OdometryGate().reject(PoseGraph(), Admission()).admitted.empty());
}

}  // namespace
}  // namespace lamp
