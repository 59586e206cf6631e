#include "lamp/pose_graph/Gnc.h"

#include <gtest/gtest.h>

#include <cstring>

#include "TestGraphs.h"
#include "lamp/core/ChiSquare.h"
#include "lamp/pose_graph/PlainOptimizers.h"

namespace lamp {
namespace {

struct Score {
  double precision, recall;
};

Score score(const OptimizationResult& result, const World& world) {
  double right = 0, accepted = 0, all = 0;
  for (const LoopVerdict& loop : result.loops) {
    const bool inlier = loop.verdict == Verdict::kInlier, is_true = world.true_edge[loop.edge];
    accepted += inlier;
    all += is_true;
    right += inlier && is_true;
  }
  return {right / accepted, right / all};
}

struct Case {
  unsigned seed;
  int outliers;
  bool planar;
};

class GncOutliers : public testing::TestWithParam<Case> {};

TEST_P(GncOutliers, AreRejectedInATwoRobotWorld) {
  WorldOptions options;
  options.seed = GetParam().seed;
  options.outliers = GetParam().outliers;
  options.planar = GetParam().planar;
  const World world = makeWorld(options);
  const OptimizationResult result = Gnc().optimize(world.graph);
  ASSERT_TRUE(result.report.usable);
  const Score got = score(result, world);
  EXPECT_EQ(got.precision, 1.0);
  EXPECT_GE(got.recall, 0.98);
  EXPECT_LT(meanDistance(result.world_T_base, world.truth), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Seeded, GncOutliers,
                         testing::Values(Case{1, 15, false}, Case{2, 60, false}, Case{3, 60, true},
                                         Case{4, 120, true}));

TEST(Gnc, VerdictsWeightsAndThresholdAgree) {
  WorldOptions options;
  options.outliers = 30;
  const World world = makeWorld(options);
  const OptimizationResult result = Gnc().optimize(world.graph);
  ASSERT_EQ(result.loops.size(), 90u);
  const double c2 = chiSquareQuantile(GncOptions().inlier_probability, 6);
  for (const LoopVerdict& loop : result.loops) {
    EXPECT_EQ(loop.verdict == Verdict::kInlier, loop.chi2 <= c2);
    EXPECT_EQ(loop.weight, loop.verdict == Verdict::kInlier ? 1.0 : 0.0);
  }
}

TEST(Gnc, WithoutOutliersItIsLm) {
  const World world = makeWorld({});
  const OptimizationResult robust = Gnc().optimize(world.graph), plain = Lm().optimize(world.graph);
  EXPECT_LE(robust.report.rounds, 3);
  EXPECT_LT(meanDistance(robust.world_T_base, plain.world_T_base), 1e-4);
}

TEST(Gnc, EachSolverAndLossFindsTheOutliers) {
  WorldOptions world_options;
  world_options.outliers = 30;
  const World world = makeWorld(world_options);
  for (const char* solver : {"Lm", "Gn", "CeresLm"})
    for (const char* loss : {"TruncatedLeastSquares", "GemanMcClure"}) {
      GncOptions options;
      options.solver = solver;
      options.loss = loss;
      const OptimizationResult result = Gnc(options).optimize(world.graph);
      ASSERT_TRUE(result.report.usable) << solver << loss << result.report.termination;
      EXPECT_EQ(score(result, world).precision, 1.0) << solver << loss;
      EXPECT_GE(score(result, world).recall, 0.98) << solver << loss;
    }
}

TEST(Gnc, ThresholdsFollowTheRankOfTheInformation) {
  WorldOptions world_options;
  world_options.outliers = 30;
  World world = makeWorld(world_options);
  for (Edge& edge : world.graph.edges())
    if (edge.mayBeRejected()) {
      edge.information.row(0).setZero();
      edge.information.col(0).setZero();
    }
  const OptimizationResult result = Gnc().optimize(world.graph);
  ASSERT_TRUE(result.report.usable);
  EXPECT_GE(score(result, world).precision, 0.98);
  EXPECT_GE(score(result, world).recall, 0.98);
  const double c2 = chiSquareQuantile(GncOptions().inlier_probability, 5);
  for (const LoopVerdict& loop : result.loops)
    EXPECT_EQ(loop.verdict == Verdict::kInlier, loop.chi2 <= c2);
}

TEST(Gnc, LoopsThatAreNotAdmittedStayOut) {
  const World world = makeWorld({});
  std::vector<bool> admitted(world.graph.edges().size(), true);
  EdgeIndex loop = 0;
  while (!world.graph.edges()[loop].mayBeRejected()) ++loop;
  admitted[loop] = false;
  const OptimizationResult result = Gnc().optimize(world.graph, admitted);
  EXPECT_EQ(result.loops[0].edge, loop);
  EXPECT_EQ(result.loops[0].verdict, Verdict::kOutlier);
  EXPECT_EQ(result.loops[0].weight, 0.0);
  EXPECT_EQ(result.loops[1].verdict, Verdict::kInlier);
}

TEST(Gnc, FormerVerdictsDoNotCount) {
  WorldOptions options;
  options.outliers = 10;
  World world = makeWorld(options);
  const OptimizationResult fresh = Gnc().optimize(world.graph);
  for (Edge& edge : world.graph.edges())
    if (edge.mayBeRejected()) edge.verdict = Verdict::kOutlier, edge.weight = 0.0;
  const OptimizationResult again = Gnc().optimize(world.graph);
  for (size_t i = 0; i < fresh.loops.size(); ++i)
    EXPECT_EQ(fresh.loops[i].verdict, again.loops[i].verdict);
}

TEST(Gnc, RobotWithoutPriorIsJoinedByLoops) {
  WorldOptions options;
  options.priors = false;
  options.outliers = 30;
  World world = makeWorld(options);
  world.graph.node(key_node(1, 0)).world_T_base = planarPose(100, 50, -2.5);
  const OptimizationResult result = Gnc().optimize(world.graph);
  EXPECT_EQ(score(result, world).precision, 1.0);
  EXPECT_GE(score(result, world).recall, 0.98);
  EXPECT_LT(meanDistance(result.world_T_base, world.truth), 0.2);
}

TEST(Gnc, RobotThatNoLoopJoinsKeepsItsFrame) {
  WorldOptions options;
  options.priors = false;
  options.loops = 0;
  World world = makeWorld(options);
  const KeyNodeId second = key_node(1, 0);
  world.graph.node(second).world_T_base = planarPose(-7, 3, 1);
  const OptimizationResult result = Gnc().optimize(world.graph);
  ASSERT_TRUE(result.report.usable);
  EXPECT_TRUE(result.world_T_base[world.graph.place(second)].isApprox(planarPose(-7, 3, 1), 1e-12));
  EXPECT_TRUE(result.loops.empty());
}

TEST(Gnc, PlanarGraphsStayPlanar) {
  WorldOptions options;
  options.planar = true;
  options.outliers = 10;
  const World world = makeWorld(options);
  const OptimizationResult result = Gnc().optimize(world.graph);
  ASSERT_EQ(result.world_T_base.size(), world.truth.size());
  for (const Pose3& pose : result.world_T_base) {
    EXPECT_EQ(pose.translation().z(), 0.0);
    EXPECT_TRUE(pose.linear().col(2).isApprox(Eigen::Vector3d::UnitZ(), 1e-15));
  }
}

TEST(Gnc, GivesTheSameBytesTwice) {
  WorldOptions options;
  options.outliers = 20;
  const World world = makeWorld(options);
  const OptimizationResult a = Gnc().optimize(world.graph), b = Gnc().optimize(world.graph);
  for (size_t i = 0; i < a.world_T_base.size(); ++i)
    EXPECT_EQ(std::memcmp(a.world_T_base[i].data(), b.world_T_base[i].data(), 16 * sizeof(double)),
              0);
  for (size_t i = 0; i < a.loops.size(); ++i) EXPECT_EQ(a.loops[i].chi2, b.loops[i].chi2);
}

/** A stretch that was matched with the wrong one: 50 loops that are off by the same motion, beside
 * 100 true ones over the same stretch. */
TEST(Gnc, FalseLoopsThatAgreeAreOutvoted) {
  for (const bool planar : {false, true}) {
    WorldOptions options;
    options.planar = planar;
    options.robots = 1;
    options.nodes = 180;
    options.loops = 0;
    World world = makeWorld(options);
    Random random(3);
    const auto addLoop = [&](int i, const Pose3& shift, bool is_true) {
      const KeyNodeId a = key_node(0, i % 50), b = key_node(0, 60 + i % 50);
      const Pose3 a_T_b =
          world.truth[world.graph.place(a)].inverse() * shift * world.truth[world.graph.place(b)];
      const Pose3 measured = a_T_b * expSE3(random.tangent(0.05, 0.01));
      world.graph.addEdge(makeEdge(EdgeType::kLoopClosure, a, b,
                                   planar ? projectToPlane(measured) : measured,
                                   informationOf(0.05, 0.01)));
      world.true_edge.push_back(is_true);
    };
    // Within what odometry allows after 60 key nodes.
    for (int i = 0; i < 50; ++i) addLoop(i, planarPose(1.5, -1.0, 0.05), false);
    for (int i = 0; i < 100; ++i) addLoop(i, Pose3::Identity(), true);
    const OptimizationResult result = Gnc().optimize(world.graph);
    EXPECT_EQ(score(result, world).precision, 1.0);
    EXPECT_GE(score(result, world).recall, 0.97);
    EXPECT_LT(meanDistance(result.world_T_base, world.truth), 0.5);
  }
}

TEST(Gnc, EmptyGraphAndLoneNode) {
  PoseGraph graph;
  EXPECT_TRUE(Gnc().optimize(graph).world_T_base.empty());
  Node node;
  node.world_T_base = planarPose(1, 2, 3);
  graph.addNode(node);
  const OptimizationResult result = Gnc().optimize(graph);
  EXPECT_TRUE(result.report.usable);
  EXPECT_TRUE(result.world_T_base[0].isApprox(node.world_T_base, 1e-12));
}

TEST(Gnc, MadeByNameAndListed) {
  registerAllClasses_lamp_pose_graph();
  EXPECT_EQ(stageClasses(CLASS_ID(Optimizer)),
            (std::vector<std::string>{"CeresLm", "Gn", "Gnc", "Lm"}));
  Faults faults;
  const Ini ini = Ini::fromText("[lamp::Gnc]\nmu_step = 2\nmax_iterations = 7\n", "t.ini", faults);
  EXPECT_TRUE(makeStage<Optimizer>(StageName::parse("Gnc"), "optimizer", "t.ini", ini, faults));
  EXPECT_TRUE(faults.empty());
  const Ini bad = Ini::fromText("[lamp::Gnc]\nmu_step = 1\n", "t.ini", faults);
  makeStage<Optimizer>(StageName::parse("Gnc"), "optimizer", "t.ini", bad, faults);
  EXPECT_FALSE(faults.empty());
}

}  // namespace
}  // namespace lamp
