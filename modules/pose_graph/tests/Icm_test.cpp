#include "lamp/pose_graph/Icm.h"

#include <gtest/gtest.h>

#include "TestGraphs.h"

namespace lamp {
namespace {

struct Score {
  double precision, recall;
};

Score score(const World& world, const std::vector<bool>& admitted) {
  double right = 0, kept = 0, all = 0;
  for (size_t e = 0; e < admitted.size(); ++e) {
    if (!world.graph.edges()[e].mayBeRejected()) continue;
    kept += admitted[e];
    all += world.true_edge[e];
    right += admitted[e] && world.true_edge[e];
  }
  return {right / kept, right / all};
}

std::vector<bool> admittedBy(Icm& icm, const PoseGraph& graph) {
  return icm.reject(graph, everything(graph)).admitted;
}

class IcmWorlds : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(All, IcmWorlds, testing::Bool());

TEST_P(IcmWorlds, KeepsWhatAgrees) {
  WorldOptions options;
  options.planar = GetParam();
  options.loops = 60;
  options.outliers = 120;
  const World world = makeWorld(options);
  Icm icm;
  const Score got = score(world, admittedBy(icm, world.graph));
  EXPECT_GE(got.precision, 0.98);
  EXPECT_GE(got.recall, 0.95);
}

TEST_P(IcmWorlds, OneByOneGivesTheSame) {
  WorldOptions options;
  options.planar = GetParam();
  options.outliers = 40;
  const World world = makeWorld(options);
  Icm at_once, grown;
  PoseGraph growing;
  for (const Node& node : world.graph.nodes()) growing.addNode(node);
  std::vector<bool> admitted;
  for (const Edge& edge : world.graph.edges()) {
    growing.addEdge(edge);
    if (edge.mayBeRejected()) admitted = admittedBy(grown, growing);
  }
  EXPECT_EQ(admitted, admittedBy(at_once, world.graph));
}

TEST(Icm, ChangedLoopsAreComparedAgain) {
  WorldOptions options;
  options.outliers = 20;
  World world = makeWorld(options);
  Icm icm;
  admittedBy(icm, world.graph);
  const World other = makeWorld({});
  Icm fresh;
  EXPECT_EQ(admittedBy(icm, other.graph), admittedBy(fresh, other.graph));
}

TEST(Icm, FixedThresholdsDependOnTheirSize) {
  WorldOptions options;
  options.robots = 1;
  options.outliers = 60;
  const World world = makeWorld(options);
  IcmOptions per_node;
  per_node.test = "per_node";
  per_node.max_translation_per_node_m = 0.5;
  per_node.max_rotation_per_node_rad = 0.05;
  Icm lamp(per_node);
  const Score loose = score(world, admittedBy(lamp, world.graph));
  EXPECT_GE(loose.recall, 0.9);
  per_node.max_rotation_per_node_rad = 1e-6;
  Icm strict(per_node);
  EXPECT_LT(score(world, admittedBy(strict, world.graph)).recall, 0.2);
}

TEST(Icm, LoopsThatAreOutAlreadyStayOut) {
  const World world = makeWorld({});
  Admission before = everything(world.graph);
  EdgeIndex loop = 0;
  while (!world.graph.edges()[loop].mayBeRejected()) ++loop;
  before.admitted[loop] = false;
  EXPECT_FALSE(Icm().reject(world.graph, before).admitted[loop]);
}

}  // namespace
}  // namespace lamp
