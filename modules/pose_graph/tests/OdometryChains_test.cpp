#include "rejection/OdometryChains.h"

#include <gtest/gtest.h>

#include "TestGraphs.h"
#include "solver/Information.h"

namespace lamp {
namespace {

World chains(bool planar) {
  WorldOptions options;
  options.planar = planar;
  options.nodes = 40;
  options.loops = 0;
  return makeWorld(options);
}

/** Covariance of a chain, composed edge by edge. */
RelativePose composedChain(const PoseGraph& graph, int robot, int first, int last) {
  RelativePose result{Pose3::Identity(), Matrix6d::Zero()};
  for (const Edge& edge : graph.edges()) {
    if (edge.type != EdgeType::kOdometry || edge.from.robot.value != robot) continue;
    const int index = static_cast<int>(edge.from.index);
    if (index < first || index >= last) continue;
    result.covariance = composeCovariance(result.covariance, edge.from_T_to,
                                          boundedCovariance(edge.information, graph.planar()));
    result.a_T_b = result.a_T_b * edge.from_T_to;
  }
  return result;
}

TEST(OdometryChains, DifferencesOfSumsAreTheComposedCovariance) {
  for (const bool planar : {false, true}) {
    const PoseGraph graph = chains(planar).graph;
    const OdometryChains odometry(graph);
    const RelativePose expected = composedChain(graph, 0, 7, 31);
    const auto got = odometry.between(key_node(0, 7), key_node(0, 31));
    ASSERT_TRUE(got);
    EXPECT_TRUE(got->a_T_b.isApprox(expected.a_T_b, 1e-9));
    EXPECT_LT((got->covariance - expected.covariance).norm(), 1e-6 * expected.covariance.norm());
  }
}

TEST(OdometryChains, AnEdgeThatSkipsAKeyNodeJoinsNoChain) {
  PoseGraph graph;
  for (int i = 0; i < 3; ++i) {
    Node node;
    node.id = key_node(0, i);
    graph.addNode(node);
  }
  graph.addEdge(makeEdge(EdgeType::kOdometry, key_node(0, 0), key_node(0, 2), planarPose(2, 0, 0),
                         informationOf(0.1, 0.1)));
  const OdometryChains odometry(graph);
  EXPECT_EQ(odometry.size(), 3);
}

TEST(OdometryChains, BackwardsIsTheInverse) {
  const PoseGraph graph = chains(false).graph;
  const OdometryChains odometry(graph);
  const auto forward = odometry.between(key_node(0, 3), key_node(0, 30));
  const auto back = odometry.between(key_node(0, 30), key_node(0, 3));
  EXPECT_TRUE((forward->a_T_b * back->a_T_b).isApprox(Pose3::Identity(), 1e-9));
  const Matrix6d Ad = adjoint(forward->a_T_b);
  EXPECT_LT((back->covariance - Ad * forward->covariance * Ad.transpose()).norm(),
            1e-6 * back->covariance.norm());
}

TEST(OdometryChains, RobotsAreRelatedByTheirPriorsOnly) {
  const World world = chains(false);
  const auto related = OdometryChains(world.graph).between(key_node(0, 10), key_node(1, 20));
  ASSERT_TRUE(related);
  const Pose3 truth = world.truth[10].inverse() * world.truth[40 + 20];
  const Vector6d error = logSE3(related->a_T_b.inverse() * truth);
  EXPECT_LT(mahalanobis2(error, related->covariance), 30.0);
  EXPECT_GT(related->covariance(0, 0), 2 * 10 * 0.02 * 0.02);

  WorldOptions options;
  options.priors = false;
  options.loops = 0;
  const PoseGraph apart = makeWorld(options).graph;
  EXPECT_FALSE(OdometryChains(apart).between(key_node(0, 10), key_node(1, 20)));
}

TEST(OdometryChains, AGapEndsTheChain) {
  PoseGraph graph = chains(false).graph;
  Node node;
  node.id = key_node(0, 41);  // 40 is missing
  graph.addNode(node);
  EXPECT_FALSE(OdometryChains(graph).between(key_node(0, 39), node.id));
}

TEST(OdometryChains, ScaleStretchesTheCovariance) {
  const PoseGraph graph = chains(false).graph;
  const OdometryChains odometry(graph);
  const auto one = odometry.between(key_node(0, 3), key_node(0, 30));
  const auto ten = odometry.between(key_node(0, 3), key_node(0, 30), 10.0);
  EXPECT_TRUE(ten->covariance.isApprox(10.0 * one->covariance, 1e-12));
}

TEST(Information, RankCountsKnownDirections) {
  Matrix6d information = informationOf(0.05, 0.001);
  EXPECT_EQ(informationRank(information, false), 6);
  EXPECT_EQ(informationRank(information, true), 3);
  information.row(0).setZero();
  information.col(0).setZero();
  EXPECT_EQ(informationRank(information, false), 5);
  EXPECT_EQ(informationRank(information, true), 2);
  Vector6d tilted = Vector6d::Ones().normalized();
  information = informationOf(0.05, 0.001);
  const Vector6d known = information * tilted;
  information -= known * known.transpose() / tilted.dot(known);
  EXPECT_EQ(informationRank(information, false), 5);
  EXPECT_EQ(informationRank(Matrix6d::Zero(), false), 0);
}

TEST(Information, UnknownDirectionsGetALargeCovariance) {
  Matrix6d information = informationOf(0.1, 0.01);
  information(2, 2) = 0;
  const Matrix6d covariance = boundedCovariance(information, false);
  EXPECT_NEAR(covariance(0, 0), 0.01, 1e-6);
  EXPECT_GT(covariance(2, 2), 1e5);
}

}  // namespace
}  // namespace lamp
