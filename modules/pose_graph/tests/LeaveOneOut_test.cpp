#include <gtest/gtest.h>

#include "TestGraphs.h"
#include "lamp/core/MeasurementEdges.h"
#include "lamp/pose_graph/PlainOptimizers.h"
#include "solver/PoseProblem.h"

namespace lamp {
namespace {

/** By so much a solve without the edge is better. */
TEST(LeaveOneOut, IsWhatTheCostFallsByWithoutTheEdge) {
  for (const bool planar : {false, true}) {
    WorldOptions options;
    options.planar = planar;
    options.loops = 20;
    World world = makeWorld(options);
    world.graph.addLandmark({"lamp"});
    for (const int i : {3, 11, 25, 40}) {
      const KeyNodeId id = key_node(0, i);
      Eigen::Vector3d seen =
          world.truth[world.graph.place(id)].inverse() * Eigen::Vector3d(4, 5, 0);
      if (planar) seen.z() = 0;
      seen.x() += 0.1 * (i % 3);
      world.graph.addEdge(positionEdge(id, 0, seen, 0.04 * Eigen::Matrix3d::Identity()));
    }
    const OptimizationResult all = Lm().optimize(world.graph);
    std::vector<Pose3> poses = all.world_T_base;
    poses.emplace_back(Eigen::Translation3d(*all.landmarks[0]));
    const std::vector<bool> everything(world.graph.edges().size(), true);
    std::vector<EdgeIndex> edges;
    for (const LoopVerdict& verdict : all.loops) edges.push_back(verdict.edge);
    const std::vector<double> distances2 =
        makePoseProblem("Lm", world.graph, poses)->leaveOneOut2(edges);
    const std::vector<double> by_ceres =
        makePoseProblem("CeresLm", world.graph, poses)->leaveOneOut2(edges);
    for (size_t i = 0; i < edges.size(); ++i) {
      std::vector<bool> others = everything;
      others[edges[i]] = false;
      const OptimizationResult without = Lm().optimize(world.graph, others);
      const double fall = 2 * (all.report.final_cost - without.report.final_cost);
      EXPECT_NEAR(distances2[i], fall, 0.03 * fall + 0.01)
          << toString(world.graph.edges()[edges[i]].type) << " " << edges[i];
      EXPECT_NEAR(distances2[i], by_ceres[i], 1e-6 * (1 + fall));
      EXPECT_NEAR(distances2[i],
                  makePoseProblem("Lm", world.graph, poses)->leaveOneOut2({edges[i]})[0],
                  1e-6 * (1 + fall))
          << "one alone, by columns of the inverse";
      EXPECT_GE(distances2[i], all.loops[i].chi2 - 1e-9) << "the others can only give way";
    }
  }
}

/** Of edges that take no part: by so much a solve with the edge is worse. */
TEST(LeaveOneOut, IsWhatTheCostRisesByWithAnEdgeThatWasOut) {
  for (const bool planar : {false, true}) {
    WorldOptions options;
    options.planar = planar;
    options.loops = 12;
    const World world = makeWorld(options);
    size_t compared = 0;
    for (EdgeIndex e = 0; e < world.graph.edges().size(); ++e) {
      if (!world.graph.edges()[e].isLoopClosure()) continue;
      std::vector<bool> others(world.graph.edges().size(), true);
      others[e] = false;
      const OptimizationResult without = Lm().optimize(world.graph, others);
      const double rise =
          2 * (Lm().optimize(world.graph).report.final_cost - without.report.final_cost);
      const auto problem = makePoseProblem("Lm", world.graph, without.world_T_base);
      problem->setWeight(e, 0.0);
      EXPECT_NEAR(problem->leaveOneOut2({e})[0], rise, 0.03 * rise + 0.01) << e;
      ++compared;
    }
    EXPECT_EQ(compared, 12u);
  }
}

/** The only loop of a graph is contradicted by nothing. */
TEST(LeaveOneOut, AnEdgeThatNothingChecksHasNoDistance) {
  WorldOptions options;
  options.priors = false;
  options.loops = 0;
  World world = makeWorld(options);
  world.graph.addEdge(makeEdge(EdgeType::kLoopClosure, key_node(0, 3), key_node(1, 5),
                               planarPose(1, 2, 3), informationOf(0.1, 0.1)));
  const OptimizationResult result = Lm().optimize(world.graph);
  const auto distances2 = makePoseProblem("Lm", world.graph, result.world_T_base)
                              ->leaveOneOut2({world.graph.edges().size() - 1});
  EXPECT_NEAR(distances2[0], 0.0, 1e-3);
}

}  // namespace
}  // namespace lamp
