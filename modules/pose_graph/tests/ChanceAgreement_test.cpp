#include "lamp/pose_graph/ChanceAgreement.h"

#include <gtest/gtest.h>

#include "TestGraphs.h"
#include "lamp/core/ChiSquare.h"
#include "lamp/pose_graph/OdometryGate.h"
#include "rejection/PoseVolume.h"

namespace lamp {
namespace {

/** Loop closures come in pairs of neighbours, as a robot that comes back finds them. */
World worldOfPairs(bool planar, double odometry_factor, int outliers) {
  WorldOptions options;
  options.planar = planar;
  options.robots = 1;
  options.nodes = 200;
  options.outliers = outliers;
  World world = makeWorld(options);
  for (Edge& edge : world.graph.edges())
    if (edge.type == EdgeType::kOdometry) edge.information /= odometry_factor * odometry_factor;
  Random random(7);
  for (int i = 0; i < 100; i += 2) {
    const KeyNodeId a = key_node(0, i), b = key_node(0, i + 60);  // two laps later
    const Pose3 a_T_b =
        world.truth[world.graph.place(a)].inverse() * world.truth[world.graph.place(b)];
    const Pose3 measured = a_T_b * expSE3(random.tangent(0.05, 0.01));
    world.graph.addEdge(makeEdge(EdgeType::kLoopClosure, a, b,
                                 planar ? projectToPlane(measured) : measured,
                                 informationOf(0.05, 0.01)));
    world.true_edge.push_back(true);
  }
  return world;
}

struct Passed {
  double right = 0, wrong = 0;
};

Passed passed(const World& world) {
  const Admission gated = OdometryGate().reject(world.graph, everything(world.graph));
  const Admission judged = ChanceAgreement().reject(world.graph, gated);
  std::vector<bool> admitted = judged.admitted;
  for (size_t e = 0; e < admitted.size(); ++e)
    if (judged.likely[e]) admitted[e] = true;
  Passed result;
  double right = 0, wrong = 0;
  for (size_t e = 0; e < admitted.size(); ++e) {
    if (!world.graph.edges()[e].mayBeRejected()) {
      EXPECT_TRUE(admitted[e]);
      continue;
    }
    (world.true_edge[e] ? right : wrong) += 1;
    if (admitted[e]) (world.true_edge[e] ? result.right : result.wrong) += 1;
  }
  return {result.right / right, result.wrong / std::max(1.0, wrong)};
}

class Chance : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(All, Chance, testing::Bool());

TEST_P(Chance, SureOdometryIsEvidenceEnough) {
  EXPECT_EQ(passed(worldOfPairs(GetParam(), 1, 100)).right, 1.0);
}

TEST_P(Chance, WhereOdometryIsVagueOnlyLoopsThatAgreeStay) {
  const Passed loops = passed(worldOfPairs(GetParam(), 20, 100));
  EXPECT_GT(loops.right, 0.9);
  EXPECT_LT(loops.wrong, 0.05);
}

TEST(PoseVolume, IsTheShareOfRandomPosesThatLieInside) {
  for (const bool planar : {true, false}) {
    PoseGraph map;
    for (int i = 0; i < 2; ++i) {
      Node node;
      node.id = key_node(0, i);
      node.planar = planar;
      map.addNode(node);
    }
    map.addEdge(makeEdge(EdgeType::kOdometry, key_node(0, 0), key_node(0, 1),
                         Pose3(Eigen::Translation3d(4, 3, 2)), informationOf(1, 1)));
    const PoseVolume volume(map, OdometryChains(map));
    const Matrix6d covariance = informationOf(0.4, 0.4).inverse();
    const double threshold = chiSquareQuantile(0.9, planar ? 3 : 6);
    Random random(1);
    int inside = 0;
    constexpr int kTrials = 2000000;
    for (int i = 0; i < kTrials; ++i) {
      Vector6d d = Vector6d::Zero();
      d.head<3>() << random.uniform(-4, 4), random.uniform(-3, 3),
          planar ? 0.0 : random.uniform(-2, 2);
      if (planar) {
        d[5] = random.uniform(-M_PI, M_PI);
      } else {
        Eigen::Quaterniond q(random.normal(), random.normal(), random.normal(), random.normal());
        Pose3 T = Pose3::Identity();
        T.linear() = q.normalized().toRotationMatrix();
        d.tail<3>() = logSE3(T).tail<3>();
      }
      inside += d.dot(covariance.inverse() * d) <= threshold;
    }
    const double share = static_cast<double>(inside) / kTrials;
    EXPECT_NEAR(volume.chance(covariance, threshold), share, 0.15 * share) << planar;
    EXPECT_EQ(volume.chance(1e6 * covariance, threshold), 1.0);
  }
}

}  // namespace
}  // namespace lamp
