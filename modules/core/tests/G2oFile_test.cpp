#include "lamp/core/G2oFile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TestSupport.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"
#include "lamp/core/GraphFiles.h"
#include "lamp/core/Program.h"

namespace lamp {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using namespace std::string_literals;

const std::string kStep = " 1 0 0.5 100 0 0 100 0 1000\n";
const std::string kStep3 = " 1 0 0 0 0 0 1 100 0 0 0 0 0 100 0 0 0 0 100 0 0 0 400 0 0 400 0 400\n";

std::string numbers(const Eigen::MatrixXd& symmetric) {
  std::string text;
  for (Eigen::Index i = 0; i < symmetric.rows(); ++i)
    for (Eigen::Index j = i; j < symmetric.cols(); ++j) text += " " + formatDouble(symmetric(i, j));
  return text;
}

std::string numbers(const Pose3& T) {
  const Eigen::Quaterniond q(T.linear());
  std::string text;
  for (const double value :
       {T.translation().x(), T.translation().y(), T.translation().z(), q.x(), q.y(), q.z(), q.w()})
    text += " " + formatDouble(value);
  return text;
}

Eigen::Matrix3d planarInformation(const G2oGraph& g2o, EdgeIndex e) {
  Eigen::Matrix3d block;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      block(i, j) = g2o.graph.edges()[e].information(kPlanarAxes[i], kPlanarAxes[j]);
  return block;
}

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
      "VERTEX_SE3:QUAT 7 1 2 3 0 0 0 2\nVERTEX_SE3:QUAT 8 5 0 0 0 0 0 1\n"
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

  expectRefused(step + sighting, {"bad.g2o:2", "EDGE_SE3_TRACKXYZ 7 20", "PARAMS_SE3OFFSET 3"});
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
  EXPECT_EQ(g2o.graph.nodes()[0].id, (KeyNodeId{RobotId{0}, 0}));
  EXPECT_EQ(g2o.name(g2o.graph.nodes()[0].id), "a5")
      << "counted from 0 within, named as in the file";
  EXPECT_EQ(g2o.graph.nodes()[2].id, (KeyNodeId{RobotId{1}, 0}));
  EXPECT_EQ(g2o.name({RobotId{1}, 1}), "b1");
  EXPECT_EQ(g2o.graph.edges()[1].type, EdgeType::kOdometry);
  EXPECT_TRUE(g2o.graph.edges()[2].betweenRobots());
}

TEST(G2oFile, PlainIdsOf64Bits) {
  const G2oGraph g2o = g2oFromText(
      "EDGE_SE2 1000000000000 1000000000001" + kStep + "EDGE_SE2 3 1000000000001" + kStep, "t");
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
  expectRefused(good + "EDGE_SE2 1 2 1 0 0 1 0 0 1 0\n", {":2", "1 2", "10 values, but needs 11"});
  expectRefused("EDGE_SE2 0 -1" + kStep, {":1", "'-1' is not an id"});
  expectRefused("EDGE_SE2 0 18446744073709551616" + kStep, {":1", "is not an id"});
  expectRefused(good + "EDGE_SE3:QUAT 1 2" + kStep3, {":2", "mixes"});
  expectRefused("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 0\n", {":1", "quaternion"});
  expectRefused("nothing here\n", {"bad.g2o"});
}

/** A text with another one in place of each occurrence of a word. */
std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

/** A chain of nodes that drives a circle of six twice, with a loop closure from each node of the
 * second round to the first. */
struct Rounds {
  std::vector<std::string> vertices, odometry, loops;

  /** \param id of each node. */
  explicit Rounds(const std::function<uint64_t(uint64_t)>& id) {
    const auto name = [&](uint64_t i) { return std::to_string(id(i)); };
    for (uint64_t i = 0; i < kNodes; ++i) {
      vertices.push_back("VERTEX_SE2 " + name(i) + " " + std::to_string(i % 6) + " 0 0\n");
      if (i > 0)
        odometry.push_back("EDGE_SE2 " + name(i - 1) + " " + name(i) + " 1 " + std::to_string(i) +
                           " 1 100 0 0 100 0 1000\n");
      if (i >= 6)
        loops.push_back("EDGE_SE2 " + name(i - 6) + " " + name(i) + " 0 0 " + std::to_string(i) +
                        " 100 0 0 100 0 1000\n");
    }
  }

  static std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line;
    return text;
  }
  std::string text() const { return joined(vertices) + joined(odometry) + joined(loops); }

  static constexpr uint64_t kNodes = 12;
};

/** Index of `from` and `to` of each odometry edge, and the name of the node at each index. */
void expectTravelled(const G2oGraph& g2o, const std::function<uint64_t(uint64_t)>& id) {
  for (uint32_t i = 0; i < Rounds::kNodes; ++i)
    EXPECT_EQ(g2o.name({RobotId{0}, i}), std::to_string(id(i)));
  size_t odometry = 0;
  for (const Edge& edge : g2o.graph.edges()) {
    if (edge.type != EdgeType::kOdometry) continue;
    EXPECT_EQ(edge.from.index + 1, edge.to.index);
    EXPECT_EQ(edge.from_T_to.translation().y(), edge.to.index) << "another edge between the two";
    ++odometry;
  }
  EXPECT_EQ(odometry, Rounds::kNodes - 1);
}

uint64_t same(uint64_t i) {
  return i;
}
uint64_t withGaps(uint64_t i) {
  return 3 + i + i / 2 * 10;
}
uint64_t shuffled(uint64_t i) {
  return 100 + 5 * i % Rounds::kNodes;
}

TEST(G2oOdometry, GapsInTheIdsMakeNone) {
  for (const auto& id : {same, withGaps}) {
    const G2oGraph g2o = g2oFromText(Rounds(id).text(), "t");
    expectTravelled(g2o, id);
    EXPECT_EQ(g2o.odometry, OdometryRule::kIds);
  }
}

TEST(G2oOdometry, IdsInNoOrderYieldToVerticesAndEdges) {
  const Rounds rounds(shuffled);
  const G2oGraph by_vertices =
      g2oFromText(Rounds::joined(rounds.vertices) + Rounds::joined(rounds.loops) +
                      Rounds::joined(rounds.odometry),
                  "t");
  expectTravelled(by_vertices, shuffled);
  EXPECT_EQ(by_vertices.odometry, OdometryRule::kVertices);

  const G2oGraph by_edges =
      g2oFromText(Rounds::joined(rounds.odometry) + Rounds::joined(rounds.loops), "t");
  expectTravelled(by_edges, shuffled);
  EXPECT_EQ(by_edges.odometry, OdometryRule::kEdges);
}

TEST(G2oOdometry, EdgesAgainstTheDirectionOfTravelChainToo) {
  std::string text;
  for (int i = 5; i > 0; --i)
    text += "EDGE_SE2 " + std::to_string(7 * i % 6) + " " + std::to_string(7 * (i - 1) % 6) + kStep;
  const G2oGraph g2o = g2oFromText(text, "t");
  for (const Edge& edge : g2o.graph.edges()) EXPECT_EQ(edge.type, EdgeType::kOdometry);
}

TEST(G2oOdometry, TwoRobotsWithInterleavedIds) {
  std::string text;
  for (int i = 0; i < 10; ++i)
    text += "EDGE_SE2 " + std::to_string(i) + " " + std::to_string(i + 2) + kStep;
  const G2oGraph g2o = g2oFromText(text + "EDGE_SE2 4 5" + kStep, "t");
  EXPECT_EQ(g2o.odometry, OdometryRule::kEdges);
  size_t odometry = 0;
  for (const Edge& edge : g2o.graph.edges()) odometry += edge.type == EdgeType::kOdometry;
  EXPECT_EQ(odometry, 10u);
  EXPECT_EQ(g2o.graph.edges().back().type, EdgeType::kLoopClosure);
}

TEST(G2oOdometry, NodesWithoutEdgesDoNotInterruptIt) {
  const G2oGraph g2o =
      g2oFromText("VERTEX_SE2 1 5 5 0\nEDGE_SE2 0 2" + kStep + "EDGE_SE2 2 3" + kStep, "t");
  EXPECT_EQ(g2o.graph.edges()[0].type, EdgeType::kOdometry);
  EXPECT_THAT(g2o.ids, ElementsAre(0, 2, 3, 1));
}

TEST(G2oOdometry, TheUserSaysWhich) {
  const std::string sessions =
      "EDGE_SE2 0 1" + kStep + "EDGE_SE2 1 50" + kStep + "EDGE_SE2 50 51" + kStep;
  const auto types = [&](const OdometryEdges& odometry) {
    std::string text;
    const G2oGraph g2o = g2oFromText(sessions, "t", odometry);
    for (const Edge& edge : g2o.graph.edges()) text += edge.type == EdgeType::kOdometry ? 'o' : 'l';
    return text;
  };
  EXPECT_EQ(types({}), "ooo");
  EXPECT_EQ(types(odometryEdgesFrom("next")), "olo") << "two drives, and a loop between them";
  EXPECT_EQ(types(odometryEdgesFrom("edges")), "ooo");

  const std::string path = test::freshFolder() + "/odometry.txt";
  writeTextFile(path, "# the second drive\n50\t51\n\n50 1 \n");
  EXPECT_EQ(types(odometryEdgesFrom(path)), "loo");
  writeTextFile(path, "0 1\n7\n");
  EXPECT_THAT(test::thrownBy([&] { odometryEdgesFrom(path); }), HasSubstr("odometry.txt:2"));
  EXPECT_THROW(odometryEdgesFrom("idds"), UsageError);
  EXPECT_THAT(test::thrownBy([&] {
                types({OdometryRule::kListed, {{0, 50}}});
              }),
              HasSubstr("0 50: the file has no edge"));
  const std::string star = "EDGE_SE2 0 1" + kStep + "EDGE_SE2 0 2" + kStep + "EDGE_SE2 0 3" + kStep;
  EXPECT_THAT(test::thrownBy([&] {
                g2oFromText(star, "t", {OdometryRule::kListed, {{0, 1}, {0, 2}, {0, 3}}});
              }),
              HasSubstr("0 3: together with the pairs before it, this is not a chain"));
}

TEST(G2oFile, FixedNodesAreWrittenBack) {
  const std::string vertices = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_SE2 2 2 0 0\n";
  const std::string edges = "EDGE_SE2 0 1" + kStep + "EDGE_SE2 1 2" + kStep;
  const G2oGraph g2o = g2oFromText("FIX 1 2\n" + vertices + edges, "t");
  EXPECT_FALSE(g2o.graph.nodes()[0].fixed);
  EXPECT_TRUE(g2o.graph.nodes()[1].fixed);
  EXPECT_TRUE(g2o.graph.nodes()[2].fixed);
  const std::string text = toG2o(g2o);
  EXPECT_THAT(text, HasSubstr("\nFIX 1\nFIX 2\n"));
  EXPECT_THAT(text, testing::Not(HasSubstr("FIX 0")));
  EXPECT_THAT(toG2o(g2oFromText(vertices + edges, "t")), HasSubstr("FIX 0\n"));

  const G2oGraph landmark = g2oFromText("VERTEX_XY 9 1 2\nFIX 9\nEDGE_SE2_XY 0 9 1 2 9 0 9\n", "t");
  EXPECT_TRUE(landmark.graph.landmarks()[0].known);
  EXPECT_THAT(toG2o(landmark), HasSubstr("FIX 9\n"));

  expectRefused(edges + "FIX 7\n", {":3", "FIX 7", "no node 7"});
  expectRefused(edges + "FIX 0 1\n", {":3", "node 0 has no VERTEX line"});
  expectRefused(edges + "FIX\n", {":3"});
  EXPECT_TRUE(g2oFromText(edges + "FIX 1\n", "t").graph.nodes()[1].fixed) << "alone, anywhere";
}

TEST(G2oFile, PriorsInThePlane) {
  const std::string edge = "EDGE_SE2 0 1" + kStep;
  const G2oGraph g2o =
      g2oFromText(edge +
                      "VERTEX_SE2 1 0 0 1.5\nEDGE_PRIOR_SE2 0 1 2 0.5 4 1 0 9 0 16\n"
                      "EDGE_PRIOR_SE2_XY 1 3 4 25 0 4\n",
                  "t");
  ASSERT_EQ(g2o.graph.edges().size(), 3u);
  const Edge& pose = g2o.graph.edges()[1];
  EXPECT_EQ(pose.type, EdgeType::kPrior);
  EXPECT_TRUE(pose.from_T_to.isApprox(planarPose(1, 2, 0.5), 1e-12));
  EXPECT_EQ(pose.information(0, 1), 1);
  EXPECT_EQ(pose.information(5, 5), 16);
  // The error in the world, of any displacement of the node, weighs as the file says.
  const Edge& position = g2o.graph.edges()[2];
  const Eigen::Vector3d moved(0.3, -0.2, 0);
  const Eigen::Vector3d error = position.from_T_to.linear().transpose() * moved;
  EXPECT_NEAR(error.dot(position.information.topLeftCorner<3, 3>() * error),
              25 * 0.3 * 0.3 + 4 * 0.2 * 0.2, 1e-9);
  EXPECT_EQ(position.information(5, 5), 0);
  const std::string text = toG2o(g2o);
  EXPECT_THAT(text, testing::Not(HasSubstr("FIX"))) << "priors hold the graph";
  const G2oGraph again = g2oFromText(text, "again");
  for (size_t e = 1; e < 3; ++e) {
    EXPECT_TRUE(again.graph.edges()[e].from_T_to.isApprox(g2o.graph.edges()[e].from_T_to, 1e-12));
    EXPECT_TRUE(planarInformation(again, e).isApprox(planarInformation(g2o, e), 1e-12));
  }
}

TEST(G2oFile, PriorsInSpaceOfASensorThatSitsElsewhere) {
  test::Random random;
  const Pose3 base_T_sensor = random.pose(), world_T_sensor = random.pose();
  const Matrix6d information = random.covariance();
  const std::string values = numbers(world_T_sensor) + numbers(toG2oInformation(information));
  const std::string rest =
      "EDGE_SE3:QUAT 0 1" + kStep3 + "PARAMS_SE3OFFSET 4" + numbers(base_T_sensor) + "\n";
  const G2oGraph g2o = g2oFromText("EDGE_SE3_PRIOR 1 4" + values + "\n" + rest, "t");
  const Edge& edge = g2o.graph.edges()[1];
  EXPECT_EQ(g2o.name(edge.from), "1");
  EXPECT_TRUE(edge.from_T_to.isApprox(world_T_sensor * base_T_sensor.inverse(), 1e-9));
  const auto chi2 = [](const Matrix6d& m, const Vector6d& d) { return d.dot(m * d); };
  const Vector6d d = random.tangent(1e-4, 1e-4);
  const Vector6d at_sensor =
      logSE3(world_T_sensor.inverse() * (edge.from_T_to * expSE3(d) * base_T_sensor));
  EXPECT_NEAR(chi2(edge.information, d) / chi2(information, at_sensor), 1, 1e-3);

  // RTAB-Map writes no parameter.
  const G2oGraph direct = g2oFromText("EDGE_SE3_PRIOR 1" + values + "\n" + rest, "t");
  EXPECT_TRUE(direct.graph.edges()[1].from_T_to.isApprox(world_T_sensor, 1e-9));
  expectRefused("EDGE_SE3_PRIOR 1 7" + values + "\n" + rest, {":1", "PARAMS_SE3OFFSET 7"});
  const G2oGraph again = g2oFromText(toG2o(g2o), "again");
  EXPECT_TRUE(again.graph.edges()[1].information.isApprox(edge.information, 1e-9));
}

TEST(G2oFile, SwitchableEdgesAreLoopClosuresLikeOthers) {
  const G2oGraph g2o = g2oFromText("EDGE_SE2 0 1" + kStep + "EDGE_SE2 1 2" + kStep +
                                       "VERTEX_SWITCH 9 1\nEDGE_SE2_SWITCHABLE 0 2 9" + kStep,
                                   "t");
  ASSERT_EQ(g2o.graph.edges().size(), 3u);
  EXPECT_EQ(g2o.graph.edges()[2].type, EdgeType::kLoopClosure);
  EXPECT_EQ(g2o.skipped.at("VERTEX_SWITCH"), 1u);
}

TEST(G2oFile, TextOfAllSystems) {
  const std::string good = Rounds(same).text(), read = toG2o(g2oFromText(good, "t"));
  for (const std::string& other :
       {"\xEF\xBB\xBF" + good, replaced(good, "\n", "\r\n"), replaced(good, "\n", "\r"),
        replaced(good, " ", "\t"), replaced(good, "\n", " # comment\n"), "% Matlab\n" + good,
        good.substr(0, good.size() - 1)}) {
    const G2oGraph g2o = g2oFromText(other, "t");
    EXPECT_EQ(toG2o(g2o), read);
    EXPECT_THAT(g2o.skipped, IsEmpty());
  }
  expectRefused(replaced(good, "0", "0\0"s), {"bad.g2o", "UTF-8"});
  expectRefused("EDGE_SE2 0 1 1,5 0 0 1 0 0 1 0 1\n", {":1", "'1,5'", "decimal points"});
  expectRefused("EDGE_SE2 0 1 1 0 0\n", {":1", "no information matrix"});
  expectRefused("VERTEX3 0 0 0 0 0 0 0\n", {"bad.g2o", "VERTEX3"});
  expectRefused("", {"bad.g2o"});
  expectRefused("FIX 0\n", {"bad.g2o"});
}

TEST(G2oFile, RepeatedAndEmptyEdgesAreTold) {
  const std::string step = "EDGE_SE2 0 1" + kStep;
  const G2oGraph g2o = g2oFromText(step + step + "EDGE_SE2 0 1 1 0 0.6 100 0 0 100 0 1000\n" +
                                       "EDGE_SE2 0 1 7 0 0 0 0 0 0 0 0\nEDGE_SE2 1 2" + kStep,
                                   "t");
  EXPECT_EQ(g2o.graph.edges().size(), 4u) << "all but the empty one";
  EXPECT_THAT(g2o.notes, ElementsAre(HasSubstr("1 edge(s) have zero information"),
                                     HasSubstr("1 edge(s) repeat another one")));
}

/** The last direction is known from the others, but for the fifth digit. */
TEST(G2oFile, InformationIsMendedIfOnlyRoundingMakesItIndefinite) {
  const auto edge = [](double last) {
    const std::string yaw = std::to_string(last);
    return "EDGE_SE2 0 1 1 0 0 100 0 " + yaw + " 100 0 400\n";
  };
  const G2oGraph g2o = g2oFromText(edge(200.002), "t");
  EXPECT_THAT(g2o.notes, ElementsAre(HasSubstr("1 edge(s) have information")));
  const Matrix6d information = g2o.graph.edges().at(0).information;
  EXPECT_NEAR(information(0, 0), 100, 1e-2);
  EXPECT_NEAR(information(0, 5), 200, 1e-2);
  EXPECT_NEAR(information(5, 5), 400, 1e-2);
  EXPECT_NO_THROW(g2oFromText(toG2o(g2o), "what was written"));
  EXPECT_THAT(g2oFromText(edge(199.998), "t").notes, IsEmpty());
  expectRefused(edge(200.1), {"semi-definite"});
}

TEST(G2oFile, NodesWithSeveralOrNoVertices) {
  const std::string edges = "EDGE_SE2 0 1" + kStep + "EDGE_SE2 1 2" + kStep;
  const std::string two = "VERTEX_SE2 0 1 2 0\nVERTEX_SE2 2 5 6 0\n";
  EXPECT_NO_THROW(g2oFromText(edges + two + "VERTEX_SE2 0 1 2 0\n", "t"));
  expectRefused(edges + two + "VERTEX_SE2 0 1 2 0.1\n", {":5", "VERTEX_SE2 0", "line 3"});
  const G2oGraph g2o = g2oFromText("VERTEX_SE2 0 1 2 0\n" + edges + two, "t");
  EXPECT_EQ(g2o.graph.nodes()[2].world_T_base.translation(), Eigen::Vector3d(5, 6, 0))
      << "stays where its vertex is";
  EXPECT_TRUE(g2o.graph.nodes()[1].world_T_base.isApprox(planarPose(2, 2, 0.5), 1e-12))
      << "from its neighbour";
}

TEST(G2oFile, NumbersBeyondAllRangesAreRefused) {
  expectRefused("EDGE_SE2 0 1 1.7e308 0 0 1 0 0 1 0 1\n", {"bad.g2o:1", "'1.7e308'"});
  expectRefused("EDGE_SE2 0 1 1 0 0 1 0 0 -1e61 0 1\n", {"bad.g2o:1", "'-1e61'"});
  expectRefused("EDGE_SE2 0 1 1e309 0 0 1 0 0 1 0 1\n", {"bad.g2o:1", "'1e309'"});
}

TEST(G2oFile, TellsInformationThatMeansNothing) {
  const auto kind = [](const std::string& odometry, const std::string& loop) {
    const std::string pose = " 1 0 0 ";
    return g2oFromText("EDGE_SE2 0 1" + pose + odometry + "EDGE_SE2 1 2" + pose + odometry +
                           "EDGE_SE2 0 2" + pose + loop,
                       "t")
        .information;
  };
  const std::string identity = "1 0 0 1 0 1\n", other = "4 0 0 4 0 90\n";
  EXPECT_EQ(kind(identity, identity), InformationKind::kIdentity);
  EXPECT_EQ(kind(identity, other), InformationKind::kStated);
  EXPECT_EQ(kind(other, other), InformationKind::kConstant);
  const std::string quaternion = " 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n";
  EXPECT_EQ(g2oFromText("EDGE_SE3:QUAT 0 1" + quaternion, "t").information,
            InformationKind::kIdentity);
  EXPECT_EQ(g2oFromText("EDGE_SE2 0 1 1 0 0 " + other + "EDGE_SE2 1 2 1 0 0 " + identity, "t")
                .information,
            InformationKind::kStated);
}

TEST(G2oFile, ReadsBackWhatItWrites) {
  test::Random random;
  std::string text;
  for (int i = 0; i < 3; ++i)
    text += "EDGE_SE3:QUAT " + std::to_string(i) + " " + std::to_string(i + 1) +
            numbers(random.pose()) + numbers(random.covariance()) + "\n";
  const G2oGraph first = g2oFromText(text, "first"), second = g2oFromText(toG2o(first), "second");
  for (size_t i = 0; i < 4; ++i)
    EXPECT_TRUE(
        second.graph.nodes()[i].world_T_base.isApprox(first.graph.nodes()[i].world_T_base, 1e-12));
  for (size_t e = 0; e < 3; ++e) {
    EXPECT_TRUE(
        second.graph.edges()[e].from_T_to.isApprox(first.graph.edges()[e].from_T_to, 1e-12));
    EXPECT_TRUE(
        second.graph.edges()[e].information.isApprox(first.graph.edges()[e].information, 1e-12));
  }
}

}  // namespace
}  // namespace lamp
