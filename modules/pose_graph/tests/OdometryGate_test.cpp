#include "lamp/pose_graph/OdometryGate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "SyntheticGraphs.h"
#include "lamp/pose_graph/FalseLoops.h"

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

TEST(OdometryGate, TellsTheScaleAmongManyFalseLoops) {
  SyntheticOptions options;
  options.nodes = 3000;
  options.loops_a_node = 0.2;
  World world = makeLongDrive(options);
  for (Edge& edge : world.graph.edges())
    if (edge.type == EdgeType::kOdometry) edge.information *= 100;
  const size_t edges = world.graph.edges().size();
  for (const double share : {0.0, 0.8, 0.95}) {
    PoseGraph graph = world.graph;
    addFalseLoops(graph, share, 5);
    const Admission gated = OdometryGate().reject(graph, everything(graph));
    EXPECT_GE(gated.odometry_scale, 16.0) << share;
    const auto right = std::count(gated.admitted.begin(), gated.admitted.begin() + edges, true);
    EXPECT_GE(right, 0.98 * static_cast<double>(edges)) << share;
  }
}

/** At one place a hundred loops may share one mistake. */
TEST(OdometryGate, LoopsOfOnePlaceAreOneWitness) {
  SyntheticOptions options;
  options.nodes = 3000;
  options.loops_a_node = 0.05;
  World world = makeLongDrive(options);
  Random random(2);
  for (int i = 0; i < 300; ++i)
    world.graph.addEdge(
        makeEdge(EdgeType::kLoopClosure, key_node(0, 100 + i % 15), key_node(0, 1000 + i % 15),
                 projectToPlane(planarPose(2, 1, 0.3) * expSE3(random.tangent(0.05, 0.005))),
                 informationOf(0.05, 0.005)));
  EXPECT_EQ(OdometryGate().reject(world.graph, everything(world.graph)).odometry_scale, 1.0);
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
