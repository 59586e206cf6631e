// What every outlier rejection and every optimizer must hold to, whoever wrote it.
#include <gtest/gtest.h>

#include <algorithm>

#include "StageSuite.h"
#include "TestGraphs.h"
#include "lamp/pose_graph/Optimizer.h"
#include "lamp/pose_graph/OutlierRejection.h"

namespace lamp {
namespace {

using test::makeDefault;
using test::testName;

std::vector<std::string> registered(const mrpt::rtti::TRuntimeClassId* base) {
  registerAllClasses_lamp_core();
  registerAllClasses_lamp_pose_graph();
  return stageClasses(base);
}

World world(bool planar, int outliers, unsigned seed = 1) {
  WorldOptions options;
  options.seed = seed;
  options.nodes = 60;
  options.loops = 40;
  options.outliers = outliers;
  options.planar = planar;
  return makeWorld(options);
}

/** Graphs with hardly anything to solve. */
std::vector<PoseGraph> smallGraphs() {
  std::vector<PoseGraph> graphs(4);
  Node node;
  for (size_t i = 1; i < graphs.size(); ++i) {
    node.id = key_node(0, 0);
    graphs[i].addNode(node);
  }
  graphs[2].addEdge(
      makeEdge(EdgeType::kPrior, node.id, node.id, planarPose(1, 2, 0.3), informationOf(0.1, 0.1)));
  node.id = key_node(1, 0);  // nothing relates it to the other one
  graphs[3].addNode(node);
  return graphs;
}

std::vector<bool> all(const PoseGraph& graph, bool admitted) {
  return std::vector<bool>(graph.edges().size(), admitted);
}

class AnyOutlierRejection : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<OutlierRejection> make() const {
    return makeDefault<OutlierRejection>(GetParam());
  }
  std::vector<bool> kept(const PoseGraph& graph) const {
    return rejection->reject(graph, everything(graph)).admitted;
  }
  const std::shared_ptr<OutlierRejection> rejection = make();
};
INSTANTIATE_TEST_SUITE_P(All, AnyOutlierRejection,
                         testing::ValuesIn(registered(CLASS_ID(OutlierRejection))), testName);

TEST_P(AnyOutlierRejection, KeepsTrueLoopsWhereAllAreTrue) {
  for (const bool planar : {false, true}) {
    const World w = world(planar, 0);
    const std::vector<bool> admitted = kept(w.graph);
    EXPECT_GE(std::count(admitted.begin(), admitted.end(), true),
              static_cast<long>(admitted.size()) - 1);
  }
}

TEST_P(AnyOutlierRejection, DecidesOnlyOverWhatMayBeRejected) {
  World w = world(false, 60);
  for (EdgeIndex e = 0; e < w.graph.edges().size(); ++e)
    w.graph.edges()[e].pinned = w.graph.edges()[e].isLoopClosure() && e % 3 == 0;
  const std::vector<bool> admitted = kept(w.graph);
  ASSERT_EQ(admitted.size(), w.graph.edges().size());
  for (EdgeIndex e = 0; e < admitted.size(); ++e)
    EXPECT_TRUE(admitted[e] || w.graph.edges()[e].mayBeRejected()) << e;
}

TEST_P(AnyOutlierRejection, AdmitsNothingThatIsOutAlready) {
  const World w = world(false, 20);
  Admission before = everything(w.graph);
  for (EdgeIndex e = 0; e < before.admitted.size(); e += 2)
    if (w.graph.edges()[e].mayBeRejected()) before.admitted[e] = false;
  const Admission after = rejection->reject(w.graph, before);
  for (EdgeIndex e = 0; e < before.admitted.size(); ++e) {
    EXPECT_TRUE(before.admitted[e] || !after.admitted[e]) << e;
    EXPECT_TRUE(before.admitted[e] || !after.waiting[e]) << e;
    EXPECT_FALSE(after.admitted[e] && after.waiting[e]) << e;
  }
}

TEST_P(AnyOutlierRejection, SaysTheSameTwiceAndKeepsNothingOfOtherGraphs) {
  const World w = world(false, 60), other = world(false, 60, 7);
  const Admission once = rejection->reject(w.graph, everything(w.graph));
  EXPECT_EQ(kept(w.graph), once.admitted);
  kept(other.graph);
  const Admission again = rejection->reject(w.graph, everything(w.graph));
  EXPECT_EQ(again.admitted, once.admitted);
  EXPECT_EQ(again.waiting, once.waiting);
  EXPECT_EQ(again.odometry_scale, once.odometry_scale);
  EXPECT_EQ(make()->reject(w.graph, everything(w.graph)).admitted, once.admitted);
}

TEST_P(AnyOutlierRejection, TakesGraphsWithHardlyAnything) {
  for (const PoseGraph& graph : smallGraphs()) {
    const Admission admission = rejection->reject(graph, everything(graph));
    EXPECT_EQ(admission.admitted, all(graph, true));
    EXPECT_EQ(admission.odometry_scale, 1.0) << "nothing contradicts odometry";
  }
}

class AnyOptimizer : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<Optimizer> make() const { return makeDefault<Optimizer>(GetParam()); }
  const std::shared_ptr<Optimizer> optimizer = make();
};
INSTANTIATE_TEST_SUITE_P(All, AnyOptimizer, testing::ValuesIn(registered(CLASS_ID(Optimizer))),
                         testName);

/** As many poses as nodes, a verdict for each edge that may be rejected, and only numbers. */
void expectComplete(const OptimizationResult& result, const PoseGraph& graph) {
  ASSERT_EQ(result.world_T_base.size(), graph.nodes().size());
  for (const Pose3& pose : result.world_T_base) {
    EXPECT_TRUE(isFinite(pose));
    EXPECT_LT((pose.linear() * pose.linear().transpose() - Eigen::Matrix3d::Identity()).norm(),
              1e-9);
  }
  EXPECT_EQ(result.landmarks.size(), graph.landmarks().size());
  size_t next = 0;
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    if (!graph.edges()[e].mayBeRejected()) continue;
    ASSERT_LT(next, result.loops.size());
    const LoopVerdict& loop = result.loops[next++];
    EXPECT_EQ(loop.edge, e);
    EXPECT_NE(loop.verdict, Verdict::kPending);
    EXPECT_TRUE(loop.weight >= 0 && loop.weight <= 1) << loop.weight;
    EXPECT_TRUE(std::isfinite(loop.chi2) && loop.chi2 >= 0) << loop.chi2;
  }
  EXPECT_EQ(next, result.loops.size());
  EXPECT_TRUE(std::isfinite(result.report.initial_cost));
  EXPECT_TRUE(std::isfinite(result.report.final_cost));
  EXPECT_FALSE(result.report.termination.empty());
}

void expectSame(const OptimizationResult& one, const OptimizationResult& two) {
  ASSERT_EQ(one.world_T_base.size(), two.world_T_base.size());
  for (size_t i = 0; i < one.world_T_base.size(); ++i)
    EXPECT_EQ(one.world_T_base[i].matrix(), two.world_T_base[i].matrix()) << i;
  ASSERT_EQ(one.loops.size(), two.loops.size());
  for (size_t i = 0; i < one.loops.size(); ++i) {
    EXPECT_EQ(one.loops[i].verdict, two.loops[i].verdict) << i;
    EXPECT_EQ(one.loops[i].chi2, two.loops[i].chi2) << i;
  }
}

TEST_P(AnyOptimizer, ComesNearTheTruthWithTrueLoops) {
  for (const bool planar : {false, true}) {
    const World w = world(planar, 0);
    std::vector<Pose3> start;
    for (const Node& node : w.graph.nodes()) start.push_back(node.world_T_base);
    const OptimizationResult result = optimizer->optimize(w.graph);
    expectComplete(result, w.graph);
    EXPECT_TRUE(result.report.usable) << result.report.termination;
    EXPECT_LT(meanDistance(result.world_T_base, w.truth), 0.5 * meanDistance(start, w.truth));
    if (!planar) continue;
    for (const Pose3& pose : result.world_T_base)
      EXPECT_LT((pose.matrix() - projectToPlane(pose).matrix()).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST_P(AnyOptimizer, LoopsThatAreNotAdmittedTakeNoPart) {
  const World w = world(false, 30);
  const OptimizationResult result = optimizer->optimize(w.graph, w.true_edge);
  expectComplete(result, w.graph);
  for (const LoopVerdict& loop : result.loops)
    if (!w.true_edge[loop.edge]) {
      EXPECT_EQ(loop.verdict, Verdict::kOutlier) << loop.edge;
    }
  World clean = world(false, 0);
  ASSERT_EQ(clean.graph.nodes().size(), w.graph.nodes().size());
  const OptimizationResult alone = make()->optimize(clean.graph);
  EXPECT_LT(meanDistance(result.world_T_base, alone.world_T_base), 1e-6);
}

TEST_P(AnyOptimizer, FollowsOdometryWithoutLoops) {
  const World w = world(false, 5);
  std::vector<bool> admitted = all(w.graph, true);
  for (EdgeIndex e = 0; e < admitted.size(); ++e) admitted[e] = !w.graph.edges()[e].isLoopClosure();
  const OptimizationResult result = optimizer->optimize(w.graph, admitted);
  expectComplete(result, w.graph);
  for (const Edge& edge : w.graph.edges()) {
    if (edge.type != EdgeType::kOdometry) continue;
    const Pose3 from_T_to = result.world_T_base[w.graph.place(edge.from)].inverse() *
                            result.world_T_base[w.graph.place(edge.to)];
    EXPECT_LT(logSE3(from_T_to.inverse() * edge.from_T_to).norm(), 1e-6);
  }
}

TEST_P(AnyOptimizer, SaysTheSameTwiceAndKeepsNothingOnceItForgets) {
  const World w = world(false, 20), other = world(false, 20, 7);
  const OptimizationResult once = optimizer->optimize(w.graph);
  optimizer->forget();
  expectSame(optimizer->optimize(w.graph), once);
  optimizer->optimize(other.graph);
  optimizer->forget();
  expectSame(optimizer->optimize(w.graph), once);
}

TEST_P(AnyOptimizer, TwoOfAClassShareNothing) {
  const World w = world(false, 20), other = world(false, 20, 7);
  const auto second = make();
  const OptimizationResult alone = make()->optimize(other.graph);
  optimizer->optimize(w.graph);
  expectSame(second->optimize(other.graph), alone);
}

TEST_P(AnyOptimizer, TakesGraphsWithHardlyAnything) {
  for (const PoseGraph& graph : smallGraphs()) {
    const OptimizationResult result = make()->optimize(graph);
    expectComplete(result, graph);
    EXPECT_TRUE(result.report.usable) << result.report.termination;
    for (const Edge& edge : graph.edges())
      EXPECT_LT(logSE3(result.world_T_base[0].inverse() * edge.from_T_to).norm(), 1e-6)
          << "the only edge is a prior";
  }
}

}  // namespace
}  // namespace lamp
