#include "lamp/pose_graph/G2oFile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TestGraphs.h"

namespace lamp {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kStep = " 1 0 0.5 100 0 0 100 0 1000\n";
const std::string kStep3 = " 1 0 0 0 0 0 1 100 0 0 0 0 0 100 0 0 0 0 100 0 0 0 400 0 0 400 0 400\n";

void expectRefused(const std::string& text, const std::vector<std::string>& parts) {
  try {
    g2oFromText(text, "bad.g2o");
    FAIL() << "read: " << text;
  } catch (const std::runtime_error& error) {
    for (const std::string& part : parts) EXPECT_THAT(error.what(), HasSubstr(part));
  }
}

TEST(G2oFile, PlanarWithoutVertices) {
  const G2oGraph g2o = g2oFromText(
      "\nEDGE_SE2 0 1" + kStep + "\nEDGE_SE2 1 2" + kStep + "EDGE_SE2 2 0" + kStep, "t");
  EXPECT_THAT(g2o.ids, ElementsAre(0, 1, 2));
  EXPECT_TRUE(g2o.graph.planar());
  ASSERT_EQ(g2o.graph.edges().size(), 3u);
  EXPECT_EQ(g2o.graph.edges()[1].type, EdgeType::kOdometry);
  EXPECT_EQ(g2o.graph.edges()[2].type, EdgeType::kLoopClosure);
  EXPECT_EQ(g2o.graph.edges()[2].verdict, Verdict::kPending);
  EXPECT_EQ(g2o.graph.edges()[0].information(5, 5), 1000);
  EXPECT_TRUE(g2o.graph.nodes()[1].world_T_base.isApprox(g2o.graph.edges()[0].from_T_to, 1e-12));
}

TEST(G2oFile, VerticesAndInformationOfQuaternions) {
  const G2oGraph g2o = g2oFromText(
      "VERTEX_SE3:QUAT 7 1 2 3 0 0 0 2\nVERTEX_SE3:QUAT 8 5 0 0 0 0 0 1\nFIX 7\n"
      "EDGE_SE3:QUAT 7 8" +
          kStep3,
      "t");
  EXPECT_TRUE(g2o.graph.nodes()[0].world_T_base.translation().isApprox(Eigen::Vector3d(1, 2, 3)));
  EXPECT_EQ(g2o.graph.edges()[0].information(0, 0), 100);
  EXPECT_EQ(g2o.graph.edges()[0].information(4, 4), 100);  // a quarter of 400
  EXPECT_FALSE(g2o.graph.planar());
}

TEST(G2oFile, LandmarksInThePlaneAndInSpace) {
  const std::string chain = "EDGE_SE2 0 1" + kStep;
  const G2oGraph planar =
      g2oFromText(chain + "EDGE_SE2_XY 0 9 2 1 25 0 16\nEDGE_SE2_XY 1 9 1 0.5 25 0 16\n", "t");
  ASSERT_EQ(planar.graph.landmarks().size(), 1u);
  EXPECT_EQ(planar.graph.landmarks()[0].name, "9");
  EXPECT_EQ(planar.graph.landmarks()[0].world_p, Eigen::Vector3d(2, 1, 0));
  EXPECT_THAT(planar.ids, ElementsAre(0, 1)) << "a landmark is no key node";
  ASSERT_EQ(planar.graph.edges().size(), 3u);
  EXPECT_EQ(planar.graph.edges()[1].type, EdgeType::kPosition);
  EXPECT_EQ(planar.graph.edges()[1].information(1, 1), 16);

  // The camera sits 1 m ahead and looks to the left.
  const std::string camera =
      "PARAMS_SE3OFFSET 3 1 0 0 0 0 0.70710678118654752 0.70710678118654752\n";
  const std::string sighting = "EDGE_SE3_TRACKXYZ 7 20 3 2 0 0.5 100 0 0 25 0 16\n";
  const std::string step = "EDGE_SE3:QUAT 7 8" + kStep3;
  const G2oGraph space = g2oFromText(step + sighting + "VERTEX_TRACKXYZ 20 1 2 3\n" + camera, "t");
  const Edge& edge = space.graph.edges()[1];
  EXPECT_LT((edge.from_T_to.translation() - Eigen::Vector3d(1, 2, 0.5)).norm(), 1e-12);
  EXPECT_NEAR(edge.information(0, 0), 25, 1e-9);
  EXPECT_NEAR(edge.information(1, 1), 100, 1e-9);
  EXPECT_EQ(space.graph.landmarks()[0].world_p, Eigen::Vector3d(1, 2, 3));

  const G2oGraph again = g2oFromText(toG2o(space), "again");
  EXPECT_TRUE(again.graph.edges()[1].from_T_to.isApprox(edge.from_T_to, 1e-12));
  EXPECT_TRUE(again.graph.edges()[1].information.isApprox(edge.information, 1e-12));
  EXPECT_EQ(again.graph.landmarks()[0].world_p, Eigen::Vector3d(1, 2, 3));

  expectRefused(step + sighting, {"bad.g2o:2", "EDGE_SE3_TRACKXYZ 7 20 3", "PARAMS_SE3OFFSET"});
  expectRefused(chain + "EDGE_SE2_XY 0 1 2 1 25 0 16\n", {"1", "landmark"});
  expectRefused(chain + "EDGE_SE2_XY 0 9 2 1 25 0 -16\n", {"bad.g2o:2", "semi-definite"});
}

TEST(G2oFile, SymbolsAreRobotsByLetter) {
  const uint64_t a5 = (uint64_t{'a'} << 56) + 5, b0 = uint64_t{'b'} << 56;
  const auto id = [](uint64_t value) { return std::to_string(value) + " "; };
  const G2oGraph g2o =
      g2oFromText("EDGE_SE2 " + id(a5) + id(a5 + 1) + kStep + "EDGE_SE2 " + id(b0) + id(b0 + 1) +
                      kStep + "EDGE_SE2 " + id(a5) + id(b0) + kStep,
                  "t");
  EXPECT_THAT(g2o.letters, ElementsAre('a', 'b'));
  EXPECT_EQ(g2o.graph.nodes()[0].id, key_node(0, 5));
  EXPECT_EQ(g2o.graph.nodes()[2].id, key_node(1, 0));
  EXPECT_EQ(g2o.name(key_node(1, 1)), "b1");
  EXPECT_EQ(g2o.graph.edges()[1].type, EdgeType::kOdometry);
  EXPECT_TRUE(g2o.graph.edges()[2].betweenRobots());
}

TEST(G2oFile, PlainIdsOf64Bits) {
  const G2oGraph g2o = g2oFromText(
      "EDGE_SE2 1000000000000 1000000000001" + kStep + "EDGE_SE2 3 1000000000000" + kStep, "t");
  EXPECT_THAT(g2o.ids, ElementsAre(3, 1000000000000, 1000000000001));
  EXPECT_EQ(g2o.graph.edges()[0].type, EdgeType::kOdometry);
  EXPECT_EQ(g2o.graph.edges()[1].type, EdgeType::kLoopClosure);
  EXPECT_EQ(g2o.name(g2o.graph.nodes()[2].id), "1000000000001");
}

TEST(G2oFile, ParallelEdgesBetweenSuccessorsAreLoops) {
  const G2oGraph g2o = g2oFromText("EDGE_SE2 1 0" + kStep + "EDGE_SE2 0 1" + kStep, "t");
  EXPECT_EQ(g2o.graph.edges()[0].type, EdgeType::kOdometry);
  EXPECT_EQ(g2o.graph.edges()[1].type, EdgeType::kLoopClosure);
}

TEST(G2oFile, UnknownTagsAreCounted) {
  const G2oGraph g2o = g2oFromText(
      "# a comment\nEDGE_RANGE 0 5 1 2 3 4 5\nEDGE_SE2 0 1" + kStep + "EDGE_RANGE x\n", "t");
  EXPECT_EQ(g2o.skipped.at("EDGE_RANGE"), 2u);
  EXPECT_EQ(g2o.skipped.size(), 1u);
}

TEST(G2oFile, FaultsNameLineAndEdge) {
  const std::string good = "EDGE_SE2 0 1" + kStep;
  expectRefused(good + "EDGE_SE2 4 4" + kStep, {"bad.g2o:2", "EDGE_SE2 4 4", "itself"});
  expectRefused(good + "EDGE_SE2 1 2 1 0 x 1 0 0 1 0 1\n", {":2", "EDGE_SE2 1 2", "'x'"});
  expectRefused(good + "EDGE_SE2 1 2 1 0 nan 1 0 0 1 0 1\n", {":2", "1 2", "not finite"});
  expectRefused(good + "EDGE_SE2 1 2 1 0 0 -1 0 0 1 0 1\n", {":2", "1 2", "semi-definite"});
  expectRefused(good + "EDGE_SE2 1 2 1 0 0 1 5 0 1 0 1\n", {":2", "1 2", "semi-definite"});
  expectRefused(good + "EDGE_SE2 1 2 1 0 0 1 0 0 1 0\n", {":2", "1 2", "10 values, needs 11"});
  expectRefused("EDGE_SE2 0 -1" + kStep, {":1", "'-1' is no id"});
  expectRefused("EDGE_SE2 0 18446744073709551616" + kStep, {":1", "is no id"});
  expectRefused(good + "EDGE_SE3:QUAT 1 2" + kStep3, {":2", "mixes"});
  expectRefused("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 0\n", {":1", "quaternion"});
  expectRefused("nothing here\n", {"bad.g2o"});
}

TEST(G2oFile, ReadsBackWhatCoreWrites) {
  WorldOptions options;
  options.robots = 1;
  const World world = makeWorld(options);
  const G2oGraph g2o = g2oFromText(toG2o(world.graph), "t");
  ASSERT_EQ(g2o.graph.nodes().size(), world.graph.nodes().size());
  ASSERT_EQ(g2o.graph.edges().size() + 1, world.graph.edges().size());  // all but the prior
  for (size_t i = 0; i < g2o.ids.size(); ++i)
    EXPECT_TRUE(
        g2o.graph.nodes()[i].world_T_base.isApprox(world.graph.nodes()[i].world_T_base, 1e-12));
  for (size_t e = 0; e < g2o.graph.edges().size(); ++e)
    EXPECT_TRUE(
        g2o.graph.edges()[e].information.isApprox(world.graph.edges()[e + 1].information, 1e-12));
}

}  // namespace
}  // namespace lamp
