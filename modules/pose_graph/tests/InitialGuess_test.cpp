#include "lamp/pose_graph/InitialGuess.h"

#include <gtest/gtest.h>

#include "TestGraphs.h"

namespace lamp {
namespace {

const Matrix6d kInformation = informationOf(0.1, 0.01);
const Pose3 kStep = poseFromYawPitchRoll((Vector6d() << 2, 0, 0.1, 0.3, 0.01, 0).finished());

PoseGraph chain(int robot, int size) {
  PoseGraph graph;
  for (int i = 0; i < size; ++i) {
    Node node;
    node.id = key_node(robot, i);
    graph.addNode(node);
    if (i > 0)
      graph.addEdge(makeEdge(EdgeType::kOdometry, key_node(robot, i - 1), key_node(robot, i), kStep,
                             kInformation));
  }
  return graph;
}

Pose3 power(const Pose3& T, int exponent) {
  Pose3 result = Pose3::Identity();
  for (int i = 0; i < std::abs(exponent); ++i) result = result * (exponent < 0 ? T.inverse() : T);
  return result;
}

TEST(InitialGuess, ChainStartsAtThePriorOfTheFirstNode) {
  PoseGraph graph = chain(0, 5);
  const Pose3 start = planarPose(3, -1, 2.0);
  graph.node(key_node(0, 0)).world_T_base = planarPose(99, 99, 0);
  graph.addEdge(makeEdge(EdgeType::kPrior, key_node(0, 0), key_node(0, 0), start, kInformation));
  const std::vector<Pose3> guess = initialGuess(graph);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(guess[i].isApprox(start * power(kStep, i), 1e-12));
}

TEST(InitialGuess, PriorInTheMiddleReachesBothWays) {
  PoseGraph graph = chain(0, 5);
  const Pose3 middle = planarPose(3, -1, 2.0);
  graph.addEdge(makeEdge(EdgeType::kPrior, key_node(0, 2), key_node(0, 2), middle, kInformation));
  const std::vector<Pose3> guess = initialGuess(graph);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(guess[i].isApprox(middle * power(kStep, i - 2), 1e-12));
}

TEST(InitialGuess, WithoutPriorTheFirstNodeKeepsItsEstimate) {
  PoseGraph graph = chain(1, 3);
  const Pose3 current = planarPose(7, 8, -1);
  graph.node(key_node(1, 0)).world_T_base = current;
  const std::vector<Pose3> guess = initialGuess(graph);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(guess[i].isApprox(current * power(kStep, i), 1e-12));
}

TEST(InitialGuess, BrokenChainGoesOnFromTheEstimateAfterTheGap) {
  PoseGraph graph = chain(0, 3);
  Node node;
  node.id = key_node(0, 4);
  node.world_T_base = planarPose(50, 0, 1);
  graph.addNode(node);
  EXPECT_TRUE(initialGuess(graph)[3].isApprox(node.world_T_base, 1e-12));
}

TEST(InitialGuess, LoopClosuresWithinAChainAreNotUsed) {
  PoseGraph graph = chain(0, 4);
  const std::vector<Pose3> before = initialGuess(graph);
  graph.addEdge(makeEdge(EdgeType::kLoopClosure, key_node(0, 0), key_node(0, 3),
                         planarPose(-9, 0, 0), kInformation));
  const std::vector<Pose3> after = initialGuess(graph);
  for (size_t i = 0; i < before.size(); ++i) EXPECT_TRUE(after[i].isApprox(before[i], 0.0));
}

TEST(InitialGuess, EmptyGraph) {
  EXPECT_TRUE(initialGuess(PoseGraph()).empty());
}

}  // namespace
}  // namespace lamp
