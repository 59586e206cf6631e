#include "lamp/core/GraphFiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <algorithm>
#include <map>

#include "MrptSupport.h"
#include "TestSupport.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"
#include "lamp/core/Ini.h"

namespace lamp {
namespace {

using mrpt::graphs::CNetworkOfPoses2DInf;
using mrpt::graphs::CNetworkOfPoses3DInf;
using test::distance;
using test::matrixOf;
using test::numericalJacobian;
using test::Random;

const RobotId kA{0}, kB{1};

/** Two robots of two key nodes, two parallel loops between them, one rejected loop, one prior. */
PoseGraph exampleGraph(bool planar) {
  Random random;
  const auto pose = [&] { return planar ? projectToPlane(random.pose()) : random.uprightPose(); };
  PoseGraph graph;
  for (const RobotId robot : {kA, kB})
    for (uint32_t i = 0; i < 2; ++i) {
      Node node;
      node.id = {robot, i};
      node.stamp = 100.5 + i;
      node.world_T_base = pose();
      node.planar = planar;
      graph.addNode(node);
    }
  const auto add = [&](EdgeType type, KeyNodeId from, KeyNodeId to, Verdict verdict) {
    Edge edge;
    edge.type = type;
    edge.from = from;
    edge.to = to;
    edge.from_T_to = pose();
    edge.information = random.covariance();
    edge.verdict = verdict;
    graph.addEdge(edge);
  };
  add(EdgeType::kOdometry, {kA, 0}, {kA, 1}, Verdict::kInlier);
  add(EdgeType::kOdometry, {kB, 0}, {kB, 1}, Verdict::kInlier);
  add(EdgeType::kLoopClosure, {kA, 1}, {kB, 0}, Verdict::kInlier);
  add(EdgeType::kLoopClosure, {kA, 1}, {kB, 0}, Verdict::kPending);
  add(EdgeType::kLoopClosure, {kA, 0}, {kB, 1}, Verdict::kOutlier);
  add(EdgeType::kPrior, {kA, 0}, {kA, 0}, Verdict::kInlier);
  return graph;
}
constexpr size_t kWrittenEdges = 4;

Eigen::Matrix3d planarBlock(const Matrix6d& m) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result(i, j) = m(kPlanarAxes[i], kPlanarAxes[j]);
  return result;
}

template <class Graph>
Graph readWithMrpt(const std::string& text) {
  const std::string path = test::freshFolder() + "/graph.txt";
  writeTextFile(path, text);
  Graph graph;
  graph.loadFromTextFile(path, false);
  return graph;
}

/** Edges in the order of the file: MRPT keeps parallel edges in the order of insertion, sorted by
 * their ends, and so are the ones of exampleGraph(). */
template <class Graph>
auto edgesInFileOrder(const Graph& graph, const PoseGraph& ours) {
  std::multimap<std::pair<uint64_t, uint64_t>, typename Graph::constraint_t> by_ends;
  for (const auto& [ends, edge] : graph.edges) by_ends.emplace(ends, edge);
  std::vector<typename Graph::constraint_t> result;
  for (const Edge& edge : ours.edges()) {
    if (result.size() == kWrittenEdges) break;
    const auto found = by_ends.find({ours.place(edge.from), ours.place(edge.to)});
    if (found == by_ends.end()) break;
    result.push_back(found->second);
    by_ends.erase(found);
  }
  return result;
}

/** The error that g2o's EdgeSE3 takes: translation, and the vector part of the unit quaternion. */
Vector6d g2oError(const Pose3& measured, const Pose3& actual) {
  const Pose3 delta = measured.inverse() * actual;
  Eigen::Quaterniond q(delta.linear());
  if (q.w() < 0) q.coeffs() *= -1;
  Vector6d error;
  error << delta.translation(), q.vec();
  return error;
}

TEST(G2oInformation, IsThatOfTheQuaternionsVectorPart) {
  Random random;
  const Pose3 T = random.pose();
  const Matrix6d information = random.covariance();
  const Matrix6d J =
      numericalJacobian([&](const Vector6d& d) { return g2oError(T, T * expSE3(d)); });
  const Matrix6d in_g2o = toG2oInformation(information);
  // The same squared error in both coordinates.
  EXPECT_LT(distance(J.transpose() * in_g2o * J, information), 1e-8);
  EXPECT_LT(distance(fromG2oInformation(in_g2o), information), 1e-14);
  EXPECT_NEAR(in_g2o(5, 5), 4 * information(5, 5), 1e-12);
}

mrpt::poses::CPose3D toMrpt(const Pose3& T) {
  const Vector6d v = yawPitchRollFromPose(T);
  return {v[0], v[1], v[2], v[3], v[4], v[5]};
}

Vector6d mrptValues(const mrpt::poses::CPose3D& p) {
  Vector6d v;
  v << p.x(), p.y(), p.z(), p.yaw(), p.pitch(), p.roll();
  return v;
}

TEST(MrptCovariance, MatchesFiniteDifferences) {
  Random random;
  for (int i = 0; i < 10; ++i) {
    const Pose3 T = random.uprightPose();
    const Vector6d at = mrptValues(toMrpt(T));
    const Matrix6d J = numericalJacobian([&](const Vector6d& d) -> Vector6d {
      return logSE3(T.inverse() * poseFromYawPitchRoll(at + d));
    });
    const Matrix6d cov = random.covariance();
    const Matrix6d tangent = covarianceFromMrpt(T, cov);
    EXPECT_LT(distance(tangent, J * cov * J.transpose()), 1e-6);
    EXPECT_LT(distance(covarianceToMrpt(T, tangent), cov), 1e-9);
  }
}

TEST(MrptCovariance, ComposesAsMrptDoes) {
  Random random;
  const Pose3 a = random.uprightPose(), b = random.uprightPose();
  const Matrix6d cov_a = 1e-4 * random.covariance(), cov_b = 1e-4 * random.covariance();
  mrpt::poses::CPose3DPDFGaussian sum(toMrpt(a), mrpt::math::CMatrixDouble66(cov_a));
  sum += mrpt::poses::CPose3DPDFGaussian(toMrpt(b), mrpt::math::CMatrixDouble66(cov_b));

  const Matrix6d ours =
      composeCovariance(covarianceFromMrpt(a, cov_a), b, covarianceFromMrpt(b, cov_b));
  const Matrix6d theirs = sum.cov.asEigen();
  EXPECT_LT(distance(covarianceToMrpt(a * b, ours), theirs), 1e-6 * theirs.cwiseAbs().maxCoeff());
}

/** Numbers of the lines that start with a word, without it. */
std::vector<std::vector<double>> linesOf(const std::string& text, const std::string& word) {
  std::vector<std::vector<double>> lines;
  for (const std::string& line : splitWords(text, '\n')) {
    const auto words = splitWords(line, ' ');
    if (words[0] != word) continue;
    lines.emplace_back();
    for (size_t i = 1; i < words.size(); ++i) {
      double value;
      EXPECT_TRUE(parseDouble(words[i], value)) << words[i];
      lines.back().push_back(value);
    }
  }
  return lines;
}

TEST(G2o, NumbersReadBackExactly) {
  const PoseGraph graph = exampleGraph(false);
  const std::string text = toG2o(graph);
  const auto vertices = linesOf(text, "VERTEX_SE3:QUAT"), edges = linesOf(text, "EDGE_SE3:QUAT");
  ASSERT_EQ(vertices.size(), graph.nodes().size());
  ASSERT_EQ(edges.size(), kWrittenEdges);
  for (size_t i = 0; i < vertices.size(); ++i) {
    ASSERT_EQ(vertices[i].size(), 8u);
    EXPECT_EQ(vertices[i][0], i);
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(vertices[i][1 + k], graph.nodes()[i].world_T_base.translation()[k]);
    const Eigen::Quaterniond q(graph.nodes()[i].world_T_base.linear());
    EXPECT_EQ(vertices[i][4], q.x());
    EXPECT_EQ(vertices[i][7], q.w());
  }
  for (size_t e = 0; e < edges.size(); ++e) {
    ASSERT_EQ(edges[e].size(), 2u + 7u + 21u);
    const Matrix6d information = toG2oInformation(graph.edges()[e].information);
    size_t at = 9;
    for (int r = 0; r < 6; ++r)
      for (int c = r; c < 6; ++c) EXPECT_EQ(edges[e][at++], information(r, c));
  }
}

TEST(G2o, FixesOneNodeOfEachComponent) {
  PoseGraph graph = exampleGraph(false);
  EXPECT_EQ(linesOf(toG2o(graph), "FIX"), (std::vector<std::vector<double>>{{0}}));
  for (Edge& edge : graph.edges())
    if (edge.mayBeRejected()) edge.verdict = Verdict::kOutlier;
  EXPECT_EQ(linesOf(toG2o(graph), "FIX"), (std::vector<std::vector<double>>{{0}, {2}}));
  EXPECT_EQ(linesOf(toG2o(graph), "EDGE_SE3:QUAT").size(), 2u);
}

TEST(G2o, MrptReadsTheSpatialGraph) {
  const PoseGraph graph = exampleGraph(false);
  const auto theirs = readWithMrpt<CNetworkOfPoses3DInf>(toG2o(graph));
  ASSERT_EQ(theirs.nodes.size(), 4u);
  const auto edges = edgesInFileOrder(theirs, graph);
  ASSERT_EQ(edges.size(), kWrittenEdges);
  for (size_t i = 0; i < 4; ++i)
    EXPECT_LT(distance(matrixOf(theirs.nodes.at(i)), graph.nodes()[i].world_T_base.matrix()),
              1e-12);
  for (size_t e = 0; e < edges.size(); ++e)
    EXPECT_LT(distance(matrixOf(edges[e].mean), graph.edges()[e].from_T_to.matrix()), 1e-12);
}

Matrix6d mrptInformation(const Edge& edge) {
  return covarianceToMrpt(edge.from_T_to, edge.information.inverse()).inverse();
}

/** MRPT's reader overwrites what it has just read between the angles with zeros. */
Matrix6d asMrptReadsIt(Matrix6d information) {
  const Eigen::Vector3d angles = information.diagonal().tail<3>();
  information.bottomRightCorner<3, 3>() = angles.asDiagonal();
  return information;
}

TEST(MrptGraph, HasTheNumbersThatMrptWrites) {
  const PoseGraph graph = exampleGraph(false);
  CNetworkOfPoses3DInf theirs;
  for (size_t i = 0; i < graph.nodes().size(); ++i)
    theirs.nodes[i] = CNetworkOfPoses3DInf::global_pose_t(toMrpt(graph.nodes()[i].world_T_base));
  for (size_t e = 0; e < kWrittenEdges; ++e) {
    const Edge& edge = graph.edges()[e];
    theirs.insertEdgeAtEnd(
        graph.place(edge.from), graph.place(edge.to),
        {toMrpt(edge.from_T_to), mrpt::math::CMatrixDouble66(mrptInformation(edge))});
  }
  const std::string path = test::freshFolder() + "/graph.txt";
  theirs.saveToTextFile(path);
  for (const char* word : {"VERTEX3", "EDGE3"}) {
    auto expected = linesOf(readTextFile(path), word), actual = linesOf(toMrptGraph(graph), word);
    std::sort(expected.begin(), expected.end());
    std::sort(actual.begin(), actual.end());
    ASSERT_EQ(actual.size(), expected.size());
    for (size_t i = 0; i < actual.size(); ++i)
      EXPECT_THAT(actual[i], testing::Pointwise(testing::DoubleNear(1e-3), expected[i]));
  }
}

TEST(MrptGraph, MrptReadsTheSpatialGraph) {
  const PoseGraph graph = exampleGraph(false);
  const auto theirs = readWithMrpt<CNetworkOfPoses3DInf>(toMrptGraph(graph));
  ASSERT_EQ(theirs.nodes.size(), 4u);
  ASSERT_EQ(theirs.edges.size(), kWrittenEdges);
  const auto edges = edgesInFileOrder(theirs, graph);
  ASSERT_EQ(edges.size(), kWrittenEdges);
  for (size_t i = 0; i < 4; ++i)
    EXPECT_LT(distance(matrixOf(theirs.nodes.at(i)), graph.nodes()[i].world_T_base.matrix()),
              1e-12);
  for (size_t e = 0; e < edges.size(); ++e) {
    const Edge& ours = graph.edges()[e];
    EXPECT_LT(distance(matrixOf(edges[e].mean), ours.from_T_to.matrix()), 1e-12);
    EXPECT_LT(distance(edges[e].cov_inv.asEigen(), asMrptReadsIt(mrptInformation(ours))), 1e-9);
  }
}

void expectPlanarGraphReadsBack(const std::string& text, const PoseGraph& graph) {
  const auto theirs = readWithMrpt<CNetworkOfPoses2DInf>(text);
  ASSERT_EQ(theirs.nodes.size(), 4u);
  ASSERT_EQ(theirs.edges.size(), kWrittenEdges);
  const auto edges = edgesInFileOrder(theirs, graph);
  ASSERT_EQ(edges.size(), kWrittenEdges);
  for (size_t i = 0; i < 4; ++i) {
    const auto& p = theirs.nodes.at(i);
    EXPECT_LT(distance(planarPose(p.x(), p.y(), p.phi()).matrix(),
                       graph.nodes()[i].world_T_base.matrix()),
              1e-12);
  }
  for (size_t e = 0; e < edges.size(); ++e) {
    const auto& p = edges[e].mean;
    EXPECT_LT(
        distance(planarPose(p.x(), p.y(), p.phi()).matrix(), graph.edges()[e].from_T_to.matrix()),
        1e-12);
    EXPECT_LT(distance(edges[e].cov_inv.asEigen(), planarBlock(graph.edges()[e].information)),
              1e-12);
  }
}

TEST(G2o, MrptReadsThePlanarGraph) {
  const PoseGraph graph = exampleGraph(true);
  expectPlanarGraphReadsBack(toG2o(graph), graph);
}

TEST(MrptGraph, MrptReadsThePlanarGraph) {
  const PoseGraph graph = exampleGraph(true);
  expectPlanarGraphReadsBack(toMrptGraph(graph), graph);
}

TEST(GraphFiles, EmptyGraphAndOneNode) {
  PoseGraph graph;
  EXPECT_EQ(toG2o(graph), "");
  EXPECT_EQ(toMrptGraph(graph), "");
  graph.addNode({});
  EXPECT_EQ(toG2o(graph), "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nFIX 0\n");
}

TEST(GraphFiles, IdsTableTellsTheKeyNodeOfEachId) {
  RobotTable robots;
  robots.add("left");
  robots.add("right");
  const CsvTable table = CsvTable::fromText(toGraphIdsCsv(exampleGraph(false), robots), "ids");
  EXPECT_THAT(table.columns, testing::ElementsAre("id", "robot", "index", "symbol", "stamp"));
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_THAT(table.rows[3], testing::ElementsAre("3", "right", "1", "7061644215716937729",
                                                  "101.500000"));  // 0x62 << 56 | 1
}

}  // namespace
}  // namespace lamp
