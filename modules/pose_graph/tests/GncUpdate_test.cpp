#include <gtest/gtest.h>

#include "TestGraphs.h"
#include "lamp/pose_graph/Gnc.h"

namespace lamp {
namespace {

/** A world whose nodes and odometry come first, loops in order behind. */
struct Growing {
  explicit Growing(const World& from) : world(from) {
    for (const Node& node : world.graph.nodes()) graph.addNode(node);
    for (const Edge& edge : world.graph.edges())
      if (edge.mayBeRejected())
        loops.push_back(edge);
      else
        graph.addEdge(edge);
  }

  void addLoops(size_t begin, size_t end) {
    for (size_t i = begin; i < std::min(end, loops.size()); ++i) graph.addEdge(loops[i]);
  }

  World world;
  PoseGraph graph;
  std::vector<Edge> loops;
};

std::vector<Verdict> verdicts(const OptimizationResult& result) {
  std::vector<Verdict> list;
  for (const LoopVerdict& loop : result.loops) list.push_back(loop.verdict);
  return list;
}

TEST(GncUpdate, EndsWhereAColdSolveEnds) {
  WorldOptions options;
  options.outliers = 30;
  Growing growing(makeWorld(options));
  std::mt19937 engine(5);
  for (size_t i = growing.loops.size() - 1; i > 0; --i)
    std::swap(growing.loops[i], growing.loops[engine() % (i + 1)]);
  Gnc warm;
  OptimizationResult result;
  for (size_t begin = 0; begin < growing.loops.size(); begin += 9) {
    growing.addLoops(begin, begin + 9);
    result = warm.optimize(growing.graph);
  }
  const OptimizationResult cold = Gnc().optimize(growing.graph);
  EXPECT_EQ(verdicts(result), verdicts(cold));
  EXPECT_LT(meanDistance(result.world_T_base, cold.world_T_base), 1e-4);
}

TEST(GncUpdate, LoopsThatAgreeCostAFewIterations) {
  Growing growing(makeWorld({}));
  growing.addLoops(0, 55);
  Gnc gnc;
  const int cold = gnc.optimize(growing.graph).report.iterations;
  growing.addLoops(55, 60);
  const OptimizationResult result = gnc.optimize(growing.graph);
  EXPECT_LE(result.report.iterations, cold);
  EXPECT_EQ(result.report.rounds, 1);
  EXPECT_EQ(result.loops.size(), 60u);
}

TEST(GncUpdate, AfterForgettingItIsACallLikeTheFirst) {
  Growing growing(makeWorld({}));
  growing.addLoops(0, 55);
  Gnc gnc;
  const OptimizationResult first = gnc.optimize(growing.graph);
  EXPECT_LT(gnc.optimize(growing.graph).report.iterations, first.report.iterations);
  gnc.forget();
  EXPECT_EQ(gnc.optimize(growing.graph).report.iterations, first.report.iterations);
}

TEST(GncUpdate, RejectedLoopsComeBackAndFalseOnesGo) {
  WorldOptions options;
  options.robots = 1;
  Growing growing(makeWorld(options));
  // A false loop first: alone, it agrees with odometry that is made vague here.
  for (Edge& edge : growing.graph.edges())
    if (edge.type == EdgeType::kOdometry) edge.information = informationOf(0.5, 0.1);
  Edge wrong = growing.loops[0];
  wrong.from_T_to.translation().x() += 3.0;
  growing.graph.addEdge(wrong);
  Gnc gnc;
  EXPECT_EQ(gnc.optimize(growing.graph).loops[0].verdict, Verdict::kInlier);
  growing.graph.addEdge(growing.loops[0]);
  gnc.optimize(growing.graph);
  growing.addLoops(1, 60);
  const OptimizationResult result = gnc.optimize(growing.graph);
  EXPECT_EQ(result.loops[0].verdict, Verdict::kOutlier);
  EXPECT_EQ(result.loops[1].verdict, Verdict::kInlier);
}

TEST(GncUpdate, NewKeyNodesFollowOdometry) {
  const World world = makeWorld({});
  PoseGraph graph = world.graph;
  Gnc gnc;
  const OptimizationResult before = gnc.optimize(graph);
  Node node;
  node.id = key_node(0, 90);
  graph.addNode(node);
  const Pose3 step = planarPose(1, 0, 0.1);
  graph.addEdge(
      makeEdge(EdgeType::kOdometry, key_node(0, 89), node.id, step, informationOf(0.02, 0.004)));
  const OptimizationResult after = gnc.optimize(graph);
  const Pose3 expected = before.world_T_base[graph.place(key_node(0, 89))] * step;
  EXPECT_TRUE(after.world_T_base.back().isApprox(expected, 1e-5));
}

TEST(GncUpdate, AnotherGraphIsNoUpdate) {
  WorldOptions options;
  options.outliers = 20;
  options.seed = 2;
  Gnc gnc;
  gnc.optimize(makeWorld({}).graph);
  const World other = makeWorld(options);
  EXPECT_EQ(verdicts(gnc.optimize(other.graph)), verdicts(Gnc().optimize(other.graph)));
}

}  // namespace
}  // namespace lamp
