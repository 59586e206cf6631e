#include <gtest/gtest.h>

#include "TestGraphs.h"
#include "lamp/pose_graph/Gnc.h"
#include "lamp/pose_graph/MarginalCovariances.h"
#include "lamp/pose_graph/PlainOptimizers.h"
#include "rejection/OdometryChains.h"

namespace lamp {
namespace {

constexpr int kFixed[] = {20, 70};

/** A robot's two and more laps, of which some key nodes are surveyed, at truth. */
struct Surveyed {
  explicit Surveyed(bool planar, bool as_priors = false) {
    WorldOptions options;
    options.planar = planar;
    options.robots = 1;
    options.priors = false;
    const World world = makeWorld(options);
    truth = world.truth;
    for (size_t i = 0; i < truth.size(); ++i) {
      Node node = world.graph.nodes()[i];
      node.fixed = !as_priors && isFixed(i);
      if (node.fixed) node.world_T_base = truth[i];
      graph.addNode(node);
    }
    for (const Edge& edge : world.graph.edges())
      if (edge.type != EdgeType::kPrior) graph.addEdge(edge);
    if (!as_priors) return;
    for (const int i : kFixed)
      graph.addEdge(makeEdge(EdgeType::kPrior, key_node(0, i), key_node(0, i), truth[i],
                             informationOf(1e-6, 1e-6)));
  }

  static bool isFixed(size_t i) {
    return std::find(std::begin(kFixed), std::end(kFixed), static_cast<int>(i)) != std::end(kFixed);
  }

  PoseGraph graph;
  std::vector<Pose3> truth;
};

std::vector<std::shared_ptr<Optimizer>> optimizers() {
  return {std::make_shared<Lm>(), std::make_shared<Gn>(), std::make_shared<CeresLm>(),
          std::make_shared<Gnc>()};
}

TEST(FixedNodes, StayAndHoldTheRestAsTightPriorsDo) {
  for (const bool planar : {false, true}) {
    const Surveyed surveyed(planar);
    const std::vector<Pose3> expected = Lm().optimize(Surveyed(planar, true).graph).world_T_base;
    for (const auto& optimizer : optimizers()) {
      const OptimizationResult result = optimizer->optimize(surveyed.graph);
      ASSERT_TRUE(result.report.usable);
      for (const int i : kFixed)
        EXPECT_TRUE(result.world_T_base[i].isApprox(surveyed.truth[i], 1e-14));
      for (size_t i = 0; i < expected.size(); ++i)
        EXPECT_LT((result.world_T_base[i].matrix() - expected[i].matrix()).norm(), 1e-4) << i;
    }
  }
}

TEST(FixedNodes, TheGuessPassesThroughThem) {
  const Surveyed surveyed(false);
  const std::vector<Pose3> guess = initialGuess(surveyed.graph);
  const OdometryChains chains(surveyed.graph);
  const auto odometry = [&](int a, int b) {
    return chains.between(key_node(0, a), key_node(0, b))->a_T_b;
  };
  for (const int i : kFixed) EXPECT_TRUE(guess[i].isApprox(surveyed.truth[i], 1e-12));
  EXPECT_TRUE(guess[3].isApprox(guess[20] * odometry(20, 3), 1e-9)) << "rigid before the first";
  EXPECT_TRUE(guess[85].isApprox(guess[70] * odometry(70, 85), 1e-9)) << "and behind the last";
  // Between them each step gives way by its part of what is missing at the end.
  const double missing =
      ((guess[20] * odometry(20, 70)).translation() - guess[70].translation()).norm();
  for (int i = 20; i < 70; ++i)
    EXPECT_LT((guess[i].translation() + guess[i].linear() * odometry(i, i + 1).translation() -
               guess[i + 1].translation())
                  .norm(),
              0.1 * missing + 0.02);
  EXPECT_GT(missing, 0.1) << "else this tests nothing";
}

TEST(FixedNodes, TreesAndChordalStartHoldThem) {
  const Surveyed surveyed(false);
  for (const auto& guess : {spanningTreeGuess(surveyed.graph), chordalGuess(surveyed.graph)})
    for (const int i : kFixed) EXPECT_TRUE(guess[i].isApprox(surveyed.truth[i], 1e-9));
}

TEST(FixedNodes, AreKnownExactly) {
  Surveyed surveyed(false);
  applyResult(Lm().optimize(surveyed.graph), surveyed.graph);
  const MarginalCovariances marginals(surveyed.graph);
  EXPECT_EQ(marginals.covariance(key_node(0, 20)), Matrix6d(Matrix6d::Zero()));
  EXPECT_GT(marginals.covariance(key_node(0, 0))(0, 0), 0);
}

TEST(FixedNodes, NothingIsLeftToDo) {
  PoseGraph graph;
  for (int i = 0; i < 3; ++i) {
    Node node;
    node.id = key_node(0, i);
    node.fixed = true;
    node.world_T_base = planarPose(i, 0, 0);
    graph.addNode(node);
  }
  const Matrix6d information = informationOf(0.1, 0.01);
  graph.addEdge(makeEdge(EdgeType::kOdometry, key_node(0, 0), key_node(0, 1), planarPose(1.1, 0, 0),
                         information));
  graph.addEdge(makeEdge(EdgeType::kLoopClosure, key_node(0, 0), key_node(0, 2),
                         planarPose(2, 0, 0), information));
  graph.addEdge(makeEdge(EdgeType::kLoopClosure, key_node(0, 2), key_node(0, 0),
                         planarPose(5, 0, 0), information));
  for (const auto& optimizer : optimizers()) {
    const OptimizationResult result = optimizer->optimize(graph);
    ASSERT_TRUE(result.report.usable) << result.report.termination;
    for (int i = 0; i < 3; ++i)
      EXPECT_TRUE(result.world_T_base[i].isApprox(planarPose(i, 0, 0), 1e-14));
  }
  const OptimizationResult result = Gnc().optimize(graph);
  EXPECT_EQ(result.loops[0].verdict, Verdict::kInlier);
  EXPECT_EQ(result.loops[1].verdict, Verdict::kOutlier);
}

}  // namespace
}  // namespace lamp
