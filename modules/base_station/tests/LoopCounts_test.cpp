#include "lamp/base_station/LoopCounts.h"

#include <gtest/gtest.h>

#include "TestTeam.h"

namespace lamp {
namespace {

using namespace test;

/** So many loop closures of robot a, of which the back end has kept some. */
PoseGraph withLoops(size_t loops, size_t kept) {
  PoseGraph graph;
  for (uint32_t i = 0; i < 2; ++i) {
    Node node;
    node.id = {kA, i};
    graph.addNode(node);
  }
  for (size_t k = 0; k < loops; ++k) {
    Edge edge;
    edge.type = EdgeType::kLoopClosure;
    edge.from = {kA, 0};
    edge.to = {kA, 1};
    edge.verdict = k < kept ? Verdict::kInlier : Verdict::kOutlier;
    graph.addEdge(edge);
  }
  return graph;
}

TEST(KeptLoops, AreTooFewBelowATenth) {
  EXPECT_TRUE(keptLoops(withLoops(21, 2), {}).tooFew());
  EXPECT_TRUE(keptLoops(withLoops(10, 0), {}).tooFew());
  EXPECT_FALSE(keptLoops(withLoops(20, 2), {}).tooFew());
  EXPECT_FALSE(keptLoops(withLoops(9, 0), {}).tooFew()) << "a tenth is less than one";
}

TEST(KeptLoops, OfRobotsThatStayApartDoNotCount) {
  PoseGraph graph = withLoops(3, 3);
  Node node;
  node.id = {kB, 0};
  graph.addNode(node);
  for (int k = 0; k < 40; ++k) {
    Edge edge;
    edge.type = EdgeType::kLoopClosure;
    edge.from = {kB, 0};
    edge.to = {kA, 1};
    edge.verdict = Verdict::kOutlier;
    graph.addEdge(edge);
  }
  FrameAgreement frames{kA, kB};
  EXPECT_EQ(keptLoops(graph, {frames}).loops, 3u);
  EXPECT_FALSE(keptLoops(graph, {frames}).tooFew());
  frames.joined = true;
  EXPECT_TRUE(keptLoops(graph, {frames}).tooFew()) << "joined, and hardly a loop closure kept";
}

}  // namespace
}  // namespace lamp
