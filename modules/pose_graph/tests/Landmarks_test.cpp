#include <gtest/gtest.h>

#include "TestGraphs.h"
#include "lamp/core/MeasurementEdges.h"
#include "lamp/pose_graph/BackEnd.h"
#include "lamp/pose_graph/Gnc.h"
#include "lamp/pose_graph/MarginalCovariances.h"
#include "lamp/pose_graph/PlainOptimizers.h"

namespace lamp {
namespace {

constexpr double kSightingM = 0.1, kSightingRad = 0.02, kRangeM = 0.1, kGravityRad = 0.005;
const Eigen::Vector3d kCamera(0.2, 0, 0.4), kAntenna(-0.1, 0.05, 0.6);

Eigen::Vector3d noise(Random& random, double sigma) {
  return {random.normal(sigma), random.normal(sigma), random.normal(sigma)};
}

Pose3 trueOf(const World& world, KeyNodeId id) {
  return world.truth[world.graph.place(id)];
}

/** What a key node's camera measures of a landmark, with an error. */
Edge sighting(const World& world, KeyNodeId id, LandmarkIndex landmark, const Eigen::Vector3d& p,
              Random& random) {
  const bool planar = world.graph.planar();
  Eigen::Vector3d camera = kCamera, seen = trueOf(world, id).inverse() * p;
  if (planar) camera.z() = seen.z() = 0;
  Eigen::Vector3d way = seen - camera;
  const double range = way.norm();
  way += range * noise(random, kSightingRad);
  way *= (range + random.normal(kSightingM)) / way.norm();
  if (planar) way.z() = 0;
  return bearingRangeEdge(id, landmark, camera, camera + way, kSightingRad, kSightingM);
}

Edge range(const World& world, KeyNodeId id, LandmarkIndex landmark, const Eigen::Vector3d& p,
           Random& random) {
  const double distance = (p - trueOf(world, id) * kAntenna).norm();
  return rangeEdge(id, landmark, kAntenna, distance + random.normal(kRangeM), kRangeM);
}

Edge gravity(const World& world, KeyNodeId id, Random& random) {
  const Eigen::Vector3d up = trueOf(world, id).linear().transpose() * Eigen::Vector3d::UnitZ() +
                             noise(random, kGravityRad);
  return gravityEdge(id, up, kGravityRad);
}

double largestDistance(const std::vector<Pose3>& a, const std::vector<Pose3>& b) {
  double largest = 0;
  for (size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, (a[i].translation() - b[i].translation()).norm());
  return largest;
}

/** Two robots that see a landmark, hear an anchor and each other, and feel gravity. */
World richWorld(bool planar, bool priors, Random& random) {
  WorldOptions options;
  options.planar = planar;
  options.priors = priors;
  World world = makeWorld(options);
  const Eigen::Vector3d artifact(6, 4, planar ? 0 : 1), anchor(3, -5, 3);
  world.graph.addLandmark({"artifact"});
  world.graph.addLandmark({"anchor", anchor, true});
  for (int robot = 0; robot < 2; ++robot)
    for (int i = 0; i < options.nodes; i += 9) {
      const KeyNodeId id = key_node(robot, i);
      world.graph.addEdge(sighting(world, id, 0, artifact, random));
      world.graph.addEdge(range(world, id, 1, anchor, random));
      world.graph.addEdge(gravity(world, id, random));
    }
  for (int i = 0; i < options.nodes; i += 7) {
    const KeyNodeId a = key_node(0, i), b = key_node(1, i);
    const double distance = (trueOf(world, a) * kAntenna - trueOf(world, b) * kAntenna).norm();
    world.graph.addEdge(
        robotRangeEdge(a, kAntenna, b, kAntenna, distance + random.normal(kRangeM), kRangeM));
  }
  return world;
}

TEST(Landmarks, OurSolverAndCeresFindTheSameOptimum) {
  for (const bool planar : {false, true}) {
    Random random(1);
    World world = richWorld(planar, true, random);
    const OptimizationResult ours = Lm().optimize(world.graph);
    const OptimizationResult ceres = CeresLm().optimize(world.graph);
    EXPECT_NEAR(ours.report.final_cost, ceres.report.final_cost, 1e-5 * ceres.report.final_cost);
    EXPECT_LT(largestDistance(ours.world_T_base, ceres.world_T_base), 1e-3);
    ASSERT_TRUE(ours.landmarks[0] && ceres.landmarks[0]);
    EXPECT_LT((*ours.landmarks[0] - *ceres.landmarks[0]).norm(), 1e-3);
    EXPECT_LT((*ours.landmarks[0] - Eigen::Vector3d(6, 4, planar ? 0 : 1)).norm(), 0.3);
    EXPECT_EQ(*ours.landmarks[1], Eigen::Vector3d(3, -5, 3)) << "it is known";
    // All terms are Gaussian: the cost is half of chi-square with so many degrees of freedom.
    EXPECT_LT(2 * ours.report.final_cost, 1.3 * (planar ? 3 : 6) * 300.0);
  }
}

TEST(Landmarks, LoseNothingToAnEdgeThatIsWrong) {
  for (const bool planar : {false, true}) {
    Random random(2);
    World world = richWorld(planar, true, random);
    const size_t right = world.graph.edges().size();
    world.graph.addEdge(sighting(world, key_node(0, 40), 0, {-9, 3, planar ? 0.0 : 2.0}, random));
    world.graph.addEdge(rangeEdge(key_node(1, 40), 1, kAntenna, 60.0, kRangeM));
    world.graph.addEdge(
        robotRangeEdge(key_node(0, 5), kAntenna, key_node(1, 5), kAntenna, 40.0, kRangeM));
    const OptimizationResult result = Gnc().optimize(world.graph);
    ASSERT_EQ(result.loops.back().edge, right + 2) << "the wrong ones are judged";
    for (const LoopVerdict& verdict : result.loops)
      EXPECT_EQ(verdict.verdict, verdict.edge < right ? Verdict::kInlier : Verdict::kOutlier)
          << toString(world.graph.edges()[verdict.edge].type) << " " << verdict.edge;
    EXPECT_LT((*result.landmarks[0] - Eigen::Vector3d(6, 4, planar ? 0 : 1)).norm(), 0.3);
  }
}

/** One robot that drives ahead while its odometry pitches, and knows no start pose. */
TEST(Landmarks, GravityLevelsAnUntiedMap) {
  constexpr int kNodes = 60;
  PoseGraph graph;
  for (int i = 0; i < kNodes; ++i) {
    Node node;
    node.id = key_node(0, i);
    graph.addNode(node);
    Vector6d step = Vector6d::Zero();
    step << 2, 0, 0, 0, 0.01, 0;
    if (i > 0)
      graph.addEdge(makeEdge(EdgeType::kOdometry, key_node(0, i - 1), node.id, expSE3(step),
                             informationOf(0.05, 0.02)));
    // The first key node stands tilted by 0.1 rad, which its frame does not know of.
    graph.addEdge(gravityEdge(node.id, {std::sin(0.1), 0, std::cos(0.1)}, kGravityRad));
  }
  for (const bool with_ceres : {false, true}) {
    const OptimizationResult result = with_ceres ? CeresLm().optimize(graph) : Lm().optimize(graph);
    ASSERT_TRUE(result.report.usable);
    EXPECT_LT(result.world_T_base[0].translation().norm(), 1e-6) << "the frame's origin stays";
    EXPECT_NEAR(yawOf(result.world_T_base[0]), 0.0, 1e-6);
    for (const Pose3& pose : result.world_T_base)
      EXPECT_NEAR(pose.linear()(2, 0), std::sin(0.1), 0.01) << "as steep as the first";
    EXPECT_NEAR(result.world_T_base.back().translation().z(), 2 * (kNodes - 1) * std::sin(0.1),
                1.5);
  }
  const MarginalCovariances marginals(graph);
  EXPECT_LT(marginals.covariance(key_node(0, 0))(4, 4), kGravityRad * kGravityRad);
}

TEST(Landmarks, DistancesAlonePlaceAnAnchor) {
  Random random(4);
  WorldOptions options;
  options.robots = 1;
  World world = makeWorld(options);
  const Eigen::Vector3d anchor(2, 3, 6);
  world.graph.addLandmark({"anchor"});
  world.graph.addLandmark({"heard once"});
  for (int i = 0; i < options.nodes; i += 3)
    world.graph.addEdge(range(world, key_node(0, i), 0, anchor, random));
  world.graph.addEdge(range(world, key_node(0, 0), 1, anchor, random));
  OptimizationResult result = Gnc().optimize(world.graph);
  ASSERT_TRUE(result.landmarks[0]);
  EXPECT_FALSE(result.landmarks[1]) << "a sphere is no place";
  EXPECT_LT((*result.landmarks[0] - anchor).norm(), 0.5);
  applyResult(result, world.graph);
  EXPECT_TRUE(world.graph.landmarks()[0].placed);
  const Eigen::Vector3d error = world.graph.landmarks()[0].world_p - anchor;
  const Eigen::Matrix3d covariance = MarginalCovariances(world.graph).landmarkCovariance(0);
  EXPECT_LT(error.dot(covariance.llt().solve(error)), 16.3);  // chi-square, 0.999
  EXPECT_LT(covariance.trace(), 0.5);
}

/** Robots of which nothing but a landmark knows both have no common frame to compare it in. */
TEST(Landmarks, DoNotTieRobotsOfUnknownStart) {
  Random random(5);
  WorldOptions options;
  options.priors = false;
  options.loops = 0;
  World world = makeWorld(options);
  const OptimizationResult before = Lm().optimize(world.graph);
  world.graph.addLandmark({"artifact"});
  for (int robot = 0; robot < 2; ++robot)
    for (int i = 0; i < 90; i += 10)
      world.graph.addEdge(sighting(world, key_node(robot, i), 0, {6, 4, 1}, random));
  world.graph.addEdge(robotRangeEdge(key_node(0, 5), kAntenna, key_node(1, 5), kAntenna, 5, 0.1));
  const OptimizationResult result = Gnc().optimize(world.graph);
  ASSERT_EQ(result.loops.size(), 19u);
  for (const LoopVerdict& verdict : result.loops) {
    const Edge& edge = world.graph.edges()[verdict.edge];
    const bool takes_part = edge.endsAtLandmark() && edge.from.robot.value == 0;
    EXPECT_EQ(verdict.verdict, takes_part ? Verdict::kInlier : Verdict::kOutlier);
  }
  for (size_t i = 90; i < 180; ++i)
    EXPECT_LT((result.world_T_base[i].translation() - before.world_T_base[i].translation()).norm(),
              1e-6);
}

}  // namespace
}  // namespace lamp
