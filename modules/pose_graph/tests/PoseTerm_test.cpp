#include "solver/PoseTerm.h"

#include <gtest/gtest.h>

#include "NumericJacobian.h"
#include "TestGraphs.h"
#include "lamp/core/MeasurementEdges.h"

namespace lamp {
namespace {

const KeyNodeId kFrom = key_node(0, 0), kTo = key_node(1, 0);

/** Two key nodes and a landmark, and one edge of each type, at odds with their poses. */
PoseGraph graphOfAllTypes(Random& random, bool planar) {
  PoseGraph graph;
  for (const KeyNodeId id : {kFrom, kTo}) {
    Node node;
    node.id = id;
    node.planar = planar;
    graph.addNode(node);
  }
  graph.addLandmark({"lamp", random.pose(4.0, 0, planar).translation()});
  const auto point = [&](double range) -> Eigen::Vector3d {
    return random.pose(range, 0, planar).translation();
  };
  const Matrix6d information = informationOf(0.1, 0.05);
  const auto pose = [&] { return random.pose(2.0, 0.4, planar); };
  graph.addEdge(makeEdge(EdgeType::kLoopClosure, kFrom, kTo, pose(), information));
  graph.addEdge(makeEdge(EdgeType::kPrior, kTo, kTo, pose(), information));
  graph.addEdge(gravityEdge(kTo, {0.2, -0.3, 0.9}, 0.02));
  graph.addEdge(positionEdge(kFrom, 0, point(4.0), 0.04 * Eigen::Matrix3d::Identity()));
  graph.addEdge(bearingRangeEdge(kFrom, 0, {0.3, 0.1, 0.5}, point(4.0), 0.05, 0.2));
  graph.addEdge(bearingRangeEdge(kFrom, 0, {0.3, 0.1, 0.5}, point(4.0), 0.05, std::nullopt));
  graph.addEdge(rangeEdge(kFrom, 0, {0.3, 0.1, 0.5}, 3.0, 0.1));
  graph.addEdge(robotRangeEdge(kFrom, {0.3, 0.1, 0.5}, kTo, {-0.2, 0.4, 0.3}, 3.0, 0.1));
  return graph;
}

template <class Space>
class PoseTermTest : public testing::Test {};
using Spaces = testing::Types<Se2, Se3>;
TYPED_TEST_SUITE(PoseTermTest, Spaces);

TYPED_TEST(PoseTermTest, JacobiansOfAllTypesMatchFiniteDifferences) {
  using Space = TypeParam;
  constexpr bool kPlanar = Space::kDof == 3;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const PoseGraph graph = graphOfAllTypes(random, kPlanar);
    std::vector<typename Space::Pose> poses;
    for (int i = 0; i < 2; ++i) poses.push_back(Space::fromPose3(random.pose(3.0, 0.7, kPlanar)));
    poses.push_back(Space::fromPose3(Pose3(Eigen::Translation3d(graph.landmarks()[0].world_p))));
    for (const PoseTerm<Space>& term : poseTerms<Space>(graph)) {
      SCOPED_TRACE(std::string(toString(term.type)) + " seed " + std::to_string(seed));
      typename Space::Jacobian d_from = Space::Jacobian::Zero(), d_to;
      term.error(poses[term.from], poses[term.to], term.isUnary() ? nullptr : &d_from, &d_to);
      for (const size_t end : {term.from, term.to}) {
        const bool is_landmark = end == 2;
        const typename Space::Jacobian& analytic = end == term.to ? d_to : d_from;
        const auto numeric = numericJacobian<Space>(poses[end], [&](const auto& pose) {
          auto moved = poses;
          moved[end] = pose;
          return term.error(moved[term.from], moved[term.to], nullptr, nullptr);
        });
        for (int axis = 0; axis < (is_landmark ? Space::kPositionDof : Space::kDof); ++axis)
          EXPECT_LT((analytic - numeric).col(axis).cwiseAbs().maxCoeff(),
                    2e-6 * (1 + numeric.col(axis).norm()))
              << "axis " << axis;
      }
    }
  }
}

/** An edge made from true poses has no error at them. */
TYPED_TEST(PoseTermTest, TrueMeasurementsHaveNoError) {
  using Space = TypeParam;
  constexpr bool kPlanar = Space::kDof == 3;
  Random random(3);
  const Pose3 from = random.pose(3.0, 0.7, kPlanar), to = random.pose(3.0, 0.7, kPlanar);
  const Eigen::Vector3d p(2.0, -1.0, kPlanar ? 0.0 : 1.5), from_p = from.inverse() * p;
  const Eigen::Vector3d at(0.3, 0.1, 0.5), at_to(-0.2, 0.4, 0.2);
  PoseGraph graph;
  for (const KeyNodeId id : {kFrom, kTo}) {
    Node node;
    node.id = id;
    node.planar = kPlanar;
    graph.addNode(node);
  }
  graph.addLandmark({"lamp", p});
  graph.addLandmark({"anchor", p + Eigen::Vector3d(0, 0, 3)});
  graph.addEdge(gravityEdge(kFrom, from.linear().transpose() * Eigen::Vector3d::UnitZ(), 0.02));
  graph.addEdge(positionEdge(kFrom, 0, from_p, 0.04 * Eigen::Matrix3d::Identity()));
  graph.addEdge(
      bearingRangeEdge(kFrom, 0, kPlanar ? Eigen::Vector3d(0.3, 0.1, 0) : at, from_p, 0.05, 0.2));
  graph.addEdge(rangeEdge(kFrom, 1, at, (graph.landmarks()[1].world_p - from * at).norm(), 0.1));
  graph.addEdge(robotRangeEdge(kFrom, at, kTo, at_to, (to * at_to - from * at).norm(), 0.1));
  std::vector<typename Space::Pose> poses;
  for (const Pose3& pose : {from, to}) poses.push_back(Space::fromPose3(pose));
  for (const Landmark& landmark : graph.landmarks())
    poses.push_back(Space::fromPose3(Pose3(Eigen::Translation3d(landmark.world_p))));
  for (const PoseTerm<Space>& term : poseTerms<Space>(graph))
    EXPECT_NEAR(term.chi2(poses[term.from], poses[term.to]), 0.0, 1e-12) << toString(term.type);
}

/** Large errors are told in full: a landmark behind the robot, a robot on its side. */
TEST(PointErrors, ErrorsAreArcsNotChords) {
  const double angle = 1.2;
  Vector6d turn = Vector6d::Zero();
  turn[3] = angle;
  const Eigen::Matrix3d R = expSE3(turn).linear();
  EXPECT_NEAR(gravityError(Eigen::Matrix3d::Identity(), R, nullptr).norm(), angle, 1e-9);
  const Eigen::Vector3d ahead(0, 2, 0);
  EXPECT_NEAR(bearingRangeError(ahead, R * ahead, nullptr).norm(), 2 * angle, 1e-9);
  EXPECT_TRUE(bearingRangeError(ahead, 3 * ahead, nullptr).isApprox(Eigen::Vector3d(0, 4, 0)));
  EXPECT_TRUE(bearingRangeError(ahead, Eigen::Vector3d::Zero(), nullptr).allFinite());
  EXPECT_TRUE(gravityError(Eigen::Matrix3d::Identity(), -R, nullptr).allFinite());
}

TEST(PoseGraphEdges, SayNothingOfWhatTheyCannotKnow) {
  Random random(1);
  const PoseGraph graph = graphOfAllTypes(random, false);
  const std::vector<int> ranks = {6, 6, 2, 3, 3, 2, 1, 1};
  for (EdgeIndex e = 0; e < ranks.size(); ++e)
    EXPECT_EQ(Eigen::FullPivLU<Matrix6d>(graph.edges()[e].information).rank(), ranks[e])
        << toString(graph.edges()[e].type);
}

}  // namespace
}  // namespace lamp
