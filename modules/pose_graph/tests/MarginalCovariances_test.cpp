#include "lamp/pose_graph/MarginalCovariances.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <stdexcept>
#include <thread>

#include "TestGraphs.h"

namespace lamp {
namespace {

Matrix6d randomCovariance(Random& random) {
  Matrix6d m;
  for (int i = 0; i < 36; ++i) m(i) = random.normal(0.02);
  return m * m.transpose() + 1e-4 * Matrix6d::Identity();
}

/** A chain with exact measurements and full covariances. */
PoseGraph randomChain(int size, unsigned seed) {
  Random random(seed);
  PoseGraph graph;
  for (int i = 0; i < size; ++i) {
    Node node;
    node.id = key_node(0, i);
    const Pose3 step = random.pose(2.0, 0.8);
    if (i > 0) node.world_T_base = graph.node(key_node(0, i - 1)).world_T_base * step;
    graph.addNode(node);
    if (i > 0)
      graph.addEdge(makeEdge(EdgeType::kOdometry, key_node(0, i - 1), node.id, step,
                             randomCovariance(random).inverse()));
  }
  return graph;
}

/** Information of all nodes' right perturbations with one node held, by finite differences of the
 * edges' residuals: the true relative covariance to first order. */
Matrix6d denseCovariance(const PoseGraph& graph, KeyNodeId from, KeyNodeId to) {
  const size_t n = graph.nodes().size();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(6 * n, 6 * n);
  constexpr double kStep = 1e-6;
  for (const Edge& edge : graph.edges()) {
    const size_t places[2] = {graph.place(edge.from), graph.place(edge.to)};
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(6, 6 * n);
    for (int end = 0; end < 2; ++end)
      for (int i = 0; i < 6; ++i) {
        const auto error = [&](double step) {
          Pose3 ends[2] = {graph.nodes()[places[0]].world_T_base,
                           graph.nodes()[places[1]].world_T_base};
          ends[end] = ends[end] * expSE3(step * Vector6d::Unit(i));
          return logSE3(edge.from_T_to.inverse() * ends[0].inverse() * ends[1]);
        };
        J.col(6 * places[end] + i) = (error(kStep) - error(-kStep)) / (2 * kStep);
      }
    H += J.transpose() * edge.information * J;
  }
  const size_t held = graph.place(from);
  H.block(6 * held, 6 * held, 6, 6) += 1e12 * Matrix6d::Identity();
  return H.inverse().block(6 * graph.place(to), 6 * graph.place(to), 6, 6);
}

/** Three loops over the chain. */
PoseGraph randomLoops(unsigned seed) {
  Random random(seed);
  PoseGraph graph = randomChain(8, seed);
  for (const auto& [a, b] : {std::make_pair(0, 5), std::make_pair(7, 2), std::make_pair(1, 6)}) {
    const KeyNodeId from = key_node(0, a), to = key_node(0, b);
    graph.addEdge(makeEdge(EdgeType::kLoopClosure, from, to,
                           graph.node(from).world_T_base.inverse() * graph.node(to).world_T_base,
                           randomCovariance(random).inverse()));
  }
  return graph;
}

TEST(MarginalCovariances, AreThoseOfTheInvertedMatrix) {
  for (const PoseGraph& graph : {randomChain(8, 1), randomLoops(2)}) {
    const MarginalCovariances uncertainty(graph);
    for (const int from : {0, 3, 7})
      for (int to = 0; to < 8; ++to) {
        if (to == from) continue;
        const Matrix6d got =
            *uncertainty.relativeCovariances(key_node(0, from), {key_node(0, to)}).front();
        const Matrix6d expected = denseCovariance(graph, key_node(0, from), key_node(0, to));
        EXPECT_LT((got - expected).norm(), 1e-4 * expected.norm()) << from << " " << to;
      }
  }
}

TEST(MarginalCovariances, OfANodeAreRelativeToTheFirstWithoutAPrior) {
  PoseGraph graph = randomLoops(4);
  const Matrix6d relative =
      *MarginalCovariances(graph).relativeCovariances(key_node(0, 0), {key_node(0, 6)}).front();
  EXPECT_TRUE(MarginalCovariances(graph).covariance(key_node(0, 6)).isApprox(relative, 1e-6));
  EXPECT_TRUE(MarginalCovariances(graph).covariance(key_node(0, 0)).isZero());

  const Matrix6d prior = informationOf(0.5, 0.2);
  graph.addEdge(makeEdge(EdgeType::kPrior, key_node(0, 0), key_node(0, 0),
                         graph.node(key_node(0, 0)).world_T_base, prior));
  const MarginalCovariances held(graph);
  EXPECT_TRUE(held.covariance(key_node(0, 0)).isApprox(prior.inverse(), 1e-4));
  EXPECT_GT(held.covariance(key_node(0, 6)).trace(), relative.trace());
  EXPECT_TRUE(
      held.relativeCovariances(key_node(0, 0), {key_node(0, 6)})[0]->isApprox(relative, 1e-4))
      << "the prior moves both";
}

TEST(MarginalCovariances, FirstQueriesMayRunInParallel) {
  const PoseGraph graph = randomLoops(3);
  const MarginalCovariances one_by_one(graph), at_once(graph);
  std::vector<Matrix6d> results(8);
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&, i] { results[i] = at_once.covariance(key_node(0, i)); });
  for (std::thread& thread : threads) thread.join();
  for (int i = 0; i < 8; ++i) EXPECT_EQ(results[i], one_by_one.covariance(key_node(0, i)));
}

TEST(MarginalCovariances, OfAGraphThatChangesAreThoseOfTheSnapshot) {
  PoseGraph graph = randomLoops(3);
  const Matrix6d expected = MarginalCovariances(graph).covariance(key_node(0, 6));
  const MarginalCovariances snapshot(graph);
  graph.node(key_node(0, 6)).world_T_base.translation().x() += 1000;
  for (Edge& edge : graph.edges()) edge.weight = 0.5;
  EXPECT_EQ(snapshot.covariance(key_node(0, 6)), expected);
}

class TwoRobots : public testing::Test {
 protected:
  TwoRobots() {
    for (const int robot : {0, 1})
      for (const int index : {0, 1}) {
        Node node;
        node.id = key_node(robot, index);
        node.world_T_base = planarPose(index, 10.0 * robot, 0);
        graph.addNode(node);
      }
    for (const int robot : {0, 1})
      graph.addEdge(makeEdge(EdgeType::kOdometry, key_node(robot, 0), key_node(robot, 1),
                             planarPose(1, 0, 0), informationOf(0.1, 0.01)));
  }
  void addPrior(int robot, double sigma_m) {
    const KeyNodeId id = key_node(robot, 0);
    graph.addEdge(makeEdge(EdgeType::kPrior, id, id, graph.node(id).world_T_base,
                           informationOf(sigma_m, 1e-3)));
  }
  EdgeIndex addLoop() {
    return graph.addEdge(makeEdge(EdgeType::kLoopClosure, key_node(0, 1), key_node(1, 1),
                                  planarPose(0, 10, 0), informationOf(0.05, 0.01)));
  }
  std::optional<Matrix6d> between() const {
    return MarginalCovariances(graph).relativeCovariances(key_node(0, 1), {key_node(1, 1)}).front();
  }
  PoseGraph graph;
};

TEST_F(TwoRobots, WithoutLoopOrPriorsAreUnrelated) {
  EXPECT_FALSE(between());
  addPrior(0, 0.5);
  EXPECT_FALSE(between());
}

TEST_F(TwoRobots, AreRelatedThroughTheWorld) {
  addPrior(0, 0.5);
  addPrior(1, 0.3);
  const auto covariance = between();
  ASSERT_TRUE(covariance);
  // x: both odometry edges, both priors, 10 m of lever arm on three of the yaw errors.
  EXPECT_NEAR((*covariance)(2, 2), 2 * 0.01 + 0.25 + 0.09 + 1e-6 + (1e-4 + 1e-6) * (100 + 1), 2e-2);
  EXPECT_NEAR((*covariance)(5, 5), 2e-4 + 2e-6, 1e-12);
}

TEST_F(TwoRobots, LoopCountsUnlessRejected) {
  addPrior(0, 0.5);
  addPrior(1, 0.3);
  const double apart = (*between())(0, 0);
  const EdgeIndex loop = addLoop();
  EXPECT_NEAR(1 / (*between())(0, 0), 1 / 0.0025 + 1 / apart, 1);
  graph.edges()[loop].verdict = Verdict::kOutlier;
  EXPECT_GT((*between())(0, 0), 0.3);
  graph.edges()[loop].verdict = Verdict::kPending;
  graph.edges()[loop].weight = 0.0;
  EXPECT_GT((*between())(0, 0), 0.3);
}

TEST_F(TwoRobots, WhatALoopDoesNotKnowIsHardlyKnown) {
  Edge loop = makeEdge(EdgeType::kLoopClosure, key_node(0, 1), key_node(1, 1), planarPose(0, 10, 0),
                       informationOf(0.05, 0.01));
  loop.information(0, 0) = 0.0;
  graph.addEdge(loop);
  const auto covariance = between();
  ASSERT_TRUE(covariance);
  EXPECT_GT((*covariance)(0, 0), 1e5);
  EXPECT_NEAR((*covariance)(1, 1), 0.0025, 1e-5);
}

TEST_F(TwoRobots, ParallelEdgesAddTheirInformation) {
  addLoop();
  graph.addEdge(makeEdge(EdgeType::kLoopClosure, key_node(1, 1), key_node(0, 1),
                         planarPose(0, -10, 0), informationOf(0.05, 1)));
  EXPECT_NEAR((*between())(1, 1), 0.0025 / 2, 1e-5);
}

TEST_F(TwoRobots, ItselfUnknownAndNone) {
  const MarginalCovariances uncertainty(graph);
  EXPECT_TRUE(uncertainty.relativeCovariances(key_node(0, 0), {key_node(0, 0)})[0]->isZero());
  EXPECT_TRUE(uncertainty.relativeCovariances(key_node(0, 0), {}).empty());
  EXPECT_THROW(uncertainty.relativeCovariances(key_node(5, 0), {}), std::out_of_range);
  const auto twice =
      uncertainty.relativeCovariances(key_node(0, 0), {key_node(0, 1), key_node(0, 1)});
  EXPECT_TRUE(twice[0]->isApprox(*twice[1], 0.0));
}

TEST(MarginalCovariancesPlanar, PlaneIsExactAndTheRestSmall) {
  PoseGraph graph;
  for (int i = 0; i < 3; ++i) {
    Node node;
    node.id = key_node(0, i);
    node.planar = true;
    node.world_T_base = planarPose(2.0 * i, 0, 0);
    graph.addNode(node);
  }
  Matrix6d information = Matrix6d::Zero();  // says nothing of z, roll, pitch
  information.diagonal() << 100, 100, 0, 0, 0, 1e4;
  for (int i : {1, 2})
    graph.addEdge(makeEdge(EdgeType::kOdometry, key_node(0, i - 1), key_node(0, i),
                           planarPose(2, 0, 0), information));
  const Matrix6d covariance =
      *MarginalCovariances(graph).relativeCovariances(key_node(0, 0), {key_node(0, 2)}).front();
  EXPECT_NEAR(covariance(0, 0), 0.02, 1e-9);
  EXPECT_NEAR(covariance(1, 1), 0.02 + 4e-4, 1e-9);
  EXPECT_NEAR(covariance(5, 5), 2e-4, 1e-12);
  EXPECT_LT(covariance(2, 2), 1e-4);
  EXPECT_TRUE(isCovariance(covariance));
}

TEST(MarginalCovariances, AllAtOnceAreThoseOfEachNode) {
  for (const bool planar : {false, true}) {
    WorldOptions options;
    options.planar = planar;
    options.priors = false;
    const World world = makeWorld(options);
    const MarginalCovariances marginals(world.graph);
    const std::vector<Matrix6d> all = marginals.covariances();
    ASSERT_EQ(all.size(), world.graph.nodes().size());
    for (size_t i = 0; i < all.size(); i += 7) {
      const Matrix6d one = marginals.covariance(world.graph.nodes()[i].id);
      EXPECT_LT((all[i] - one).norm(), 1e-6 * (1e-6 + one.norm())) << i;
    }
  }
}

}  // namespace
}  // namespace lamp
