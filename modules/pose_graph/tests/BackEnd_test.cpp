#include "lamp/pose_graph/BackEnd.h"

#include <gtest/gtest.h>

#include "SyntheticGraphs.h"
#include "lamp/core/G2oFile.h"
#include "lamp/pose_graph/ChanceAgreement.h"
#include "lamp/pose_graph/FalseLoops.h"
#include "lamp/pose_graph/Gnc.h"
#include "lamp/pose_graph/OdometryGate.h"
#include "lamp/pose_graph/PlainOptimizers.h"
#include "lamp/pose_graph/RobotFrames.h"

namespace lamp {
namespace {

OptimizationResult optimize(const PoseGraph& graph) {
  const BackEnd back_end{{std::make_shared<OdometryGate>(), std::make_shared<ChanceAgreement>(),
                          std::make_shared<RobotFrames>()},
                         std::make_shared<Gnc>()};
  return back_end.optimize(graph);
}

struct Kept {
  double right = 0, wrong = 0, all = 0;
  double recall() const { return right / all; }
  double precision() const { return right / std::max(1.0, right + wrong); }
};

/** \param edges of which all are true; those behind them are false. */
Kept kept(const OptimizationResult& result, size_t edges) {
  Kept counts;
  for (const LoopVerdict& loop : result.loops) {
    const bool is_true = loop.edge < edges;
    counts.all += is_true;
    if (loop.verdict == Verdict::kInlier) ++(is_true ? counts.right : counts.wrong);
  }
  return counts;
}

struct Named {
  const char* name;
  World (*make)();
};

World grid(double gap_share) {
  SyntheticOptions options;
  options.nodes = 500;
  options.loops_a_node = 2;
  options.gap_share = gap_share;
  options.odometry_m = 0.05;
  options.odometry_rad = 0.01;
  return makeGrid(options);
}

World longDrive() {
  SyntheticOptions options;
  options.nodes = 4000;
  options.loops_a_node = 0.1;
  options.odometry_rad = 0.008;
  return makeLongDrive(options);
}

World tunnels() {
  SyntheticOptions options;
  options.robots = 8;
  options.nodes = 100;
  return makeTunnels(options);
}

World brokenGrid() {
  SyntheticOptions options;
  options.nodes = 1000;
  options.loops_a_node = 2;
  options.pieces = 6;
  options.odometry_m = 0.05;
  options.odometry_rad = 0.01;
  return makeGrid(options);
}

class HardGraphs : public testing::TestWithParam<Named> {};
INSTANTIATE_TEST_SUITE_P(All, HardGraphs,
                         testing::Values(Named{"grid", [] { return grid(0); }},
                                         Named{"gridWithGaps", [] { return grid(0.07); }},
                                         Named{"brokenGrid", brokenGrid},
                                         Named{"longDrive", longDrive}, Named{"tunnels", tunnels}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST_P(HardGraphs, CleanOnesKeepTheirLoopsAndEndAsLowAsAPlainSolve) {
  const World world = GetParam().make();
  const OptimizationResult robust = optimize(world.graph);
  ASSERT_TRUE(robust.report.usable);
  ASSERT_GT(robust.loops.size(), 300u);
  EXPECT_GE(kept(robust, world.graph.edges().size()).recall(), 0.995);
  PlainOptions from_odometry;
  from_odometry.start = "odometry";
  const OptimizationResult plain = Lm(from_odometry).optimize(world.graph);
  // Each loop that is out costs its threshold; of six degrees of freedom the largest.
  const double out = 0.5 * 27.9 * (1.0 - kept(robust, world.graph.edges().size()).recall()) *
                     static_cast<double>(robust.loops.size());
  EXPECT_LE(robust.report.final_cost + out, plain.report.final_cost * (1 + 1e-6) + out);
}

TEST_P(HardGraphs, FalseLoopsAreFoundInFewIterations) {
  const World world = GetParam().make();
  for (const double share : {0.2, 0.5}) {
    PoseGraph graph = world.graph;
    addFalseLoops(graph, share, 1);
    const OptimizationResult result = optimize(graph);
    ASSERT_TRUE(result.report.usable);
    const Kept loops = kept(result, world.graph.edges().size());
    EXPECT_GE(loops.precision(), 0.99) << share;
    EXPECT_GE(loops.recall(), 0.99) << share;
    EXPECT_LE(result.report.iterations, 60) << share;
  }
}

/** Odometry that drifts more than it says, and places that were taken for others: false loops that
 * agree, and beside them those that do not. */
TEST(BackEnd, DriftAndMistakenPlacesAreOutvoted) {
  SyntheticOptions options;
  options.loops_a_node = 0.2;
  options.odometry_bias_rad = 0.001;
  options.nodes = 3000;
  options.mistaken_places = 10;
  SyntheticOptions team = options;
  team.robots = 4;
  team.nodes = 200;
  team.loops_a_node = 1;
  team.mistaken_places = 15;
  for (const World& world : {makeLongDrive(options), makeTunnels(team)})
    for (const double share : {0.0, 0.5}) {
      PoseGraph graph = world.graph;
      addFalseLoops(graph, share, 1);
      Kept loops;
      const OptimizationResult result = optimize(graph);
      for (const LoopVerdict& loop : result.loops) {
        const bool is_true = loop.edge < world.true_edge.size() && world.true_edge[loop.edge];
        loops.all += is_true;
        if (loop.verdict == Verdict::kInlier) ++(is_true ? loops.right : loops.wrong);
      }
      EXPECT_GE(loops.precision(), 0.99) << share;
      EXPECT_GE(loops.recall(), 0.99) << share;
      EXPECT_LE(result.report.iterations, 120) << share;
    }
}

/** A square of which only one loop closes the end to the start. */
PoseGraph oneLap() {
  PoseGraph graph;
  for (int i = 0; i < 400; ++i) {
    Node node;
    node.id = key_node(0, i);
    node.planar = true;
    graph.addNode(node);
    if (i > 0)
      graph.addEdge(makeEdge(EdgeType::kOdometry, key_node(0, i - 1), node.id,
                             planarPose(1, 0, i % 100 == 0 ? M_PI / 2 : 0),
                             informationOf(0.1, 0.05)));
  }
  graph.addEdge(makeEdge(EdgeType::kLoopClosure, key_node(0, 399), key_node(0, 0),
                         planarPose(1, 1, M_PI / 2 + 0.1), informationOf(0.05, 0.01)));
  return graph;
}

TEST(BackEnd, ALoneLoopClosesALongDriveUnlessManyLoopsAreFalse) {
  PoseGraph graph = oneLap();
  const EdgeIndex loop = graph.edges().size() - 1;
  EXPECT_EQ(optimize(graph).loops[0].verdict, Verdict::kInlier);
  // Near to one another in time: odometry contradicts these.
  for (int i = 0; i < 60; ++i)
    graph.addEdge(makeEdge(EdgeType::kLoopClosure, key_node(0, 5 * i), key_node(0, 5 * i + 20),
                           planarPose(-30, 20, 2), informationOf(0.05, 0.01)));
  const OptimizationResult among_false = optimize(graph);
  ASSERT_EQ(among_false.loops[0].edge, loop);
  for (const LoopVerdict& verdict : among_false.loops)
    EXPECT_EQ(verdict.verdict, Verdict::kOutlier) << verdict.edge;
}

/** As often as it may be written. */
TEST(BackEnd, ARepeatedLoopIsOneWitness) {
  PoseGraph graph = oneLap();
  for (int i = 0; i < 60; ++i)
    graph.addEdge(makeEdge(EdgeType::kLoopClosure, key_node(0, 5 * i), key_node(0, 5 * i + 20),
                           planarPose(-30, 20, 2), informationOf(0.05, 0.01)));
  const Edge lone = graph.edges()[399];
  ASSERT_TRUE(lone.isLoopClosure());
  for (int i = 0; i < 30; ++i) graph.addEdge(lone);
  for (const LoopVerdict& verdict : optimize(graph).loops)
    EXPECT_EQ(verdict.verdict, Verdict::kOutlier) << verdict.edge;

  PoseGraph good = oneLap();
  good.addEdge(lone);
  Edge odometry = good.edges()[7];
  odometry.type = EdgeType::kLoopClosure;
  good.addEdge(odometry);
  const OptimizationResult once = optimize(oneLap()), result = optimize(good);
  for (const LoopVerdict& verdict : result.loops) EXPECT_EQ(verdict.verdict, Verdict::kInlier);
  EXPECT_EQ(meanDistance(result.world_T_base, once.world_T_base), 0.0);
}

TEST(BackEnd, LoopsThatWaitComeInWhenTheSolutionBearsThemOut) {
  World world = longDrive();
  PoseGraph graph = world.graph;
  addFalseLoops(graph, 0.5, 3);
  Admission admission = OdometryGate().reject(graph, everything(graph));
  admission = ChanceAgreement().reject(graph, admission);
  size_t waiting = 0;
  for (EdgeIndex e = 0; e < world.graph.edges().size(); ++e) waiting += admission.waiting[e];
  ASSERT_GT(waiting, 0u);
  const OptimizationResult at_once = Gnc().optimize(graph, admission.admitted);
  EXPECT_GT(kept(optimize(graph), world.graph.edges().size()).right,
            kept(at_once, world.graph.edges().size()).right);
}

TEST(BackEnd, RecordedGraphsKeepTheirLoops) {
  if (dataFolder().empty()) GTEST_SKIP() << "no recorded pose graphs";
  for (const char* name : {"intel", "CSAIL", "kitti_00"}) {
    const PoseGraph clean = readG2oFile(dataFolder() + "/pose_graphs/" + name + ".g2o").graph;
    for (const double share : {0.0, 0.5}) {
      PoseGraph graph = clean;
      addFalseLoops(graph, share, 1);
      const Kept loops = kept(optimize(graph), clean.edges().size());
      EXPECT_GE(loops.recall(), 0.995) << name << " " << share;
      EXPECT_GE(loops.precision(), 0.99) << name << " " << share;
    }
  }
}

}  // namespace
}  // namespace lamp
