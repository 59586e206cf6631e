#include "lamp/pose_graph/PlainOptimizers.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "CeresAutoDiff.h"
#include "TestGraphs.h"

namespace lamp {
namespace {

double independentOptimum(const PoseGraph& graph) {
  ceres::Solver::Options options;
  options.initial_trust_region_radius = 1e8;
  options.function_tolerance = 1e-9;
  options.max_num_iterations = 200;
  return solveWithAutoDiff(graph, options);
}

double rmse(const std::vector<Pose3>& poses, const std::vector<Pose3>& truth) {
  double sum = 0;
  for (size_t i = 0; i < poses.size(); ++i)
    sum += (poses[i].translation() - truth[i].translation()).squaredNorm();
  return std::sqrt(sum / static_cast<double>(poses.size()));
}

std::vector<Pose3> estimates(const PoseGraph& graph) {
  std::vector<Pose3> result;
  for (const Node& node : graph.nodes()) result.push_back(node.world_T_base);
  return result;
}

Node nodeAt(KeyNodeId id, const Pose3& world_T_base = Pose3::Identity(), bool planar = false) {
  Node node;
  node.id = id;
  node.world_T_base = world_T_base;
  node.planar = planar;
  return node;
}

class PlainOptimizers : public testing::TestWithParam<std::string> {
 protected:
  static OptimizationResult optimize(const PoseGraph& graph) {
    return optimize(graph, std::vector<bool>(graph.edges().size(), true));
  }
  static OptimizationResult optimize(const PoseGraph& graph, const std::vector<bool>& admitted) {
    if (GetParam() == "Lm") return Lm().optimize(graph, admitted);
    if (GetParam() == "Gn") return Gn().optimize(graph, admitted);
    return CeresLm().optimize(graph, admitted);
  }
};

INSTANTIATE_TEST_SUITE_P(All, PlainOptimizers, testing::Values("Lm", "Gn", "CeresLm"),
                         [](const auto& name) { return name.param; });

TEST_P(PlainOptimizers, ReachesTheOptimumOfAnIndependentProblem) {
  const World world = makeWorld({});
  const OptimizationResult result = optimize(world.graph);
  ASSERT_TRUE(result.report.usable);
  EXPECT_NEAR(result.report.final_cost / independentOptimum(world.graph), 1.0, 1e-6);
  EXPECT_LT(result.report.final_cost, 0.1 * result.report.initial_cost);
}

TEST_P(PlainOptimizers, ReachesTheOptimumOfParkingGarage) {
  if (dataFolder().empty()) GTEST_SKIP() << "no recordings: set LAMP_DATA to their folder";
  const PoseGraph graph = readG2o(dataFolder() + "/pose_graphs/parking-garage.g2o");
  ASSERT_EQ(graph.nodes().size(), 1661u);
  ASSERT_EQ(graph.edges().size(), 6276u);
  const OptimizationResult result = optimize(graph);
  EXPECT_NEAR(result.report.final_cost / independentOptimum(graph), 1.0, 1e-4);
  // 1.2688 is the published optimum of sum of squares with g2o's quaternion residual.
  EXPECT_NEAR(2 * result.report.final_cost, 1.2688, 0.05);
}

TEST_P(PlainOptimizers, FindsTheTruth) {
  for (const bool planar : {false, true}) {
    WorldOptions options;
    options.planar = planar;
    const World world = makeWorld(options);
    const double before = rmse(estimates(world.graph), world.truth);
    const double after = rmse(optimize(world.graph).world_T_base, world.truth);
    EXPECT_GT(before, 0.3);
    EXPECT_LT(after, 0.15);
    EXPECT_LT(after, 0.3 * before);
  }
}

TEST_P(PlainOptimizers, CostOfTheTrueModelIsHalfItsDegreesOfFreedom) {
  WorldOptions options;
  for (const int dof : {6, 3}) {
    options.planar = dof == 3;
    options.loops = 200;
    const World world = makeWorld(options);
    const double redundancy = dof * (static_cast<double>(world.graph.edges().size()) -
                                     static_cast<double>(world.truth.size()));
    EXPECT_NEAR(2 * optimize(world.graph).report.final_cost, redundancy,
                4 * std::sqrt(2 * redundancy));
  }
}

TEST_P(PlainOptimizers, PlanarGraphsStayPlanar) {
  WorldOptions options;
  options.planar = true;
  const World world = makeWorld(options);
  const OptimizationResult result = optimize(world.graph);
  ASSERT_EQ(result.world_T_base.size(), world.truth.size());
  for (const Pose3& pose : result.world_T_base) {
    EXPECT_EQ(pose.translation().z(), 0.0);
    EXPECT_TRUE(pose.linear().col(2).isApprox(Eigen::Vector3d::UnitZ(), 1e-15));
  }
}

TEST_P(PlainOptimizers, GivesTheSameBytesTwice) {
  const World world = makeWorld({});
  const OptimizationResult a = optimize(world.graph), b = optimize(world.graph);
  ASSERT_EQ(a.world_T_base.size(), b.world_T_base.size());
  for (size_t i = 0; i < a.world_T_base.size(); ++i)
    EXPECT_EQ(std::memcmp(a.world_T_base[i].data(), b.world_T_base[i].data(), 16 * sizeof(double)),
              0);
}

TEST_P(PlainOptimizers, RejectedLoopsStayOut) {
  WorldOptions options;
  options.outliers = 20;
  World world = makeWorld(options);
  const OptimizationResult result = optimize(world.graph, world.true_edge);
  EXPECT_LT(rmse(result.world_T_base, world.truth), 0.15);
  ASSERT_EQ(result.loops.size(), 80u);
  for (const LoopVerdict& loop : result.loops) {
    const bool inlier = world.true_edge[loop.edge];
    EXPECT_EQ(loop.verdict, inlier ? Verdict::kInlier : Verdict::kOutlier);
    EXPECT_EQ(loop.weight, inlier ? 1.0 : 0.0);
    EXPECT_EQ(loop.chi2 < 50.0, inlier);
  }
  applyResult(result, world.graph);
  EXPECT_LT(rmse(estimates(world.graph), world.truth), 0.15);
}

TEST_P(PlainOptimizers, EmptyGraphAndLoneNode) {
  PoseGraph graph;
  EXPECT_TRUE(optimize(graph).world_T_base.empty());
  const Pose3 current = planarPose(1, 2, 0.5);
  graph.addNode(nodeAt(key_node(0, 0), current));
  const OptimizationResult alone = optimize(graph);
  ASSERT_TRUE(alone.report.usable) << alone.report.termination;
  EXPECT_TRUE(alone.world_T_base[0].isApprox(current, 1e-15));

  const Pose3 start = planarPose(4, 5, -1);
  graph.addEdge(
      makeEdge(EdgeType::kPrior, key_node(0, 0), key_node(0, 0), start, informationOf(0.1, 0.1)));
  EXPECT_TRUE(optimize(graph).world_T_base[0].isApprox(start, 1e-9));
}

TEST_P(PlainOptimizers, ComponentsWithoutPriorKeepTheirFirstNode) {
  WorldOptions options;
  options.priors = false;
  options.loops = 0;
  World world = makeWorld(options);
  const KeyNodeId second = key_node(1, 0);
  const Pose3 current = planarPose(-7, 3, 1);
  world.graph.node(second).world_T_base = current;
  const OptimizationResult result = optimize(world.graph);
  ASSERT_TRUE(result.report.usable);
  EXPECT_TRUE(result.world_T_base[world.graph.place(second)].isApprox(current, 1e-15));
  EXPECT_LT(result.report.final_cost, 1e-9);  // odometry alone is met exactly
}

TEST_P(PlainOptimizers, ParallelEdgesAddTheirInformation) {
  PoseGraph graph;
  for (int i : {0, 1}) graph.addNode(nodeAt(key_node(0, i)));
  const auto add = [&](EdgeType type, double x, double sigma) {
    graph.addEdge(makeEdge(type, key_node(0, 0), key_node(0, 1), planarPose(x, 0, 0),
                           informationOf(sigma, 0.1)));
  };
  add(EdgeType::kOdometry, 1.0, 0.1);
  add(EdgeType::kLoopClosure, 2.0, 0.1);
  add(EdgeType::kLoopClosure, 2.0, 0.1);
  const OptimizationResult result = optimize(graph);
  EXPECT_NEAR(result.world_T_base[1].translation().x(), 5.0 / 3.0, 1e-6);
  EXPECT_EQ(result.loops.size(), 2u);
  EXPECT_NEAR(result.loops[0].chi2, 100.0 / 9.0, 1e-4);
}

TEST_P(PlainOptimizers, LoopWithRankDeficientInformationCountsWhereItKnows) {
  PoseGraph graph;
  for (int i : {0, 1}) graph.addNode(nodeAt(key_node(0, i)));
  graph.addEdge(makeEdge(EdgeType::kOdometry, key_node(0, 0), key_node(0, 1), planarPose(1, 0, 0),
                         informationOf(0.1, 1e-4)));
  Vector6d direction = Vector6d::Zero();
  direction.head<2>() << 1, 1;  // knows x + y only
  graph.addEdge(makeEdge(EdgeType::kLoopClosure, key_node(0, 0), key_node(0, 1),
                         planarPose(2, 0, 0), 1e6 * direction * direction.transpose()));
  const OptimizationResult result = optimize(graph);
  ASSERT_TRUE(result.report.usable);
  const Eigen::Vector3d t = result.world_T_base[1].translation();
  EXPECT_NEAR(t.x() + t.y(), 2.0, 1e-3);
  EXPECT_NEAR(t.x() - t.y(), 1.0, 1e-3);
  EXPECT_NEAR(t.z(), 0.0, 1e-9);
}

TEST_P(PlainOptimizers, PoseThatIsNotFiniteIsNamed) {
  PoseGraph graph;
  Pose3 broken = Pose3::Identity();
  broken(0, 3) = std::numeric_limits<double>::quiet_NaN();
  graph.addNode(nodeAt(key_node(0, 7), broken));
  try {
    optimize(graph);
    FAIL() << "nothing thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("key node 7"), std::string::npos) << error.what();
  }
}

/** Two key nodes that only a loop joins, which says nothing of the distance along x. */
PoseGraph slidingPair() {
  PoseGraph graph;
  for (int robot : {0, 1}) graph.addNode(nodeAt(key_node(robot, 0), planarPose(3.0 * robot, 0, 0)));
  Edge loop = makeEdge(EdgeType::kLoopClosure, key_node(0, 0), key_node(1, 0), planarPose(5, 2, 0),
                       informationOf(0.1, 0.01));
  loop.information.row(0).setZero();
  loop.information.col(0).setZero();
  graph.addEdge(loop);
  return graph;
}

TEST(Lm, StaysWhereItIsInDirectionsThatNothingKnows) {
  const OptimizationResult result = Lm().optimize(slidingPair());
  ASSERT_TRUE(result.report.usable);
  EXPECT_NEAR(result.world_T_base[1].translation().x(), 3.0, 1e-3);
  EXPECT_NEAR(result.world_T_base[1].translation().y(), 2.0, 1e-3);
}

TEST(Gn, SaysThatTheNormalEquationsAreSingular) {
  const OptimizationResult result = Gn().optimize(slidingPair());
  EXPECT_FALSE(result.report.usable);
  EXPECT_NE(result.report.termination.find("singular"), std::string::npos);
  EXPECT_TRUE(result.world_T_base[1].isApprox(planarPose(3, 0, 0), 1e-15));
}

}  // namespace
}  // namespace lamp
