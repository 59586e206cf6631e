#include "lamp/pose_graph/Lm.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <limits>

#include "TestGraphs.h"

namespace lamp {
namespace {

/** The same residual written down again: quaternions, automatic derivatives, Cholesky. */
class AutoDiffEdge {
 public:
  explicit AutoDiffEdge(const Edge& edge) : prior_(edge.type == EdgeType::kPrior) {
    const Eigen::Quaterniond q(edge.from_T_to.linear());
    measured_ = {q.w(), -q.x(), -q.y(), -q.z()};
    for (int i = 0; i < 3; ++i) translation_[i] = edge.from_T_to.translation()[i];
    root_ = edge.information.llt().matrixU();
  }

  template <class T>
  bool operator()(const T* to_q, const T* to_t, T* residual) const {
    const T q[4] = {T(1), T(0), T(0), T(0)}, t[3] = {T(0), T(0), T(0)};
    return (*this)(q, t, to_q, to_t, residual);
  }

  template <class T>
  bool operator()(const T* from_q, const T* from_t, const T* to_q, const T* to_t,
                  T* residual) const {
    const T inverse[4] = {from_q[0], -from_q[1], -from_q[2], -from_q[3]};
    const T difference[3] = {to_t[0] - from_t[0], to_t[1] - from_t[1], to_t[2] - from_t[2]};
    T moved[3], t[3], relative[4], q[4], w[3];
    const T measured[4] = {T(measured_[0]), T(measured_[1]), T(measured_[2]), T(measured_[3])};
    ceres::UnitQuaternionRotatePoint(inverse, difference, moved);
    for (int i = 0; i < 3; ++i) moved[i] -= translation_[i];
    ceres::UnitQuaternionRotatePoint(measured, moved, t);
    ceres::QuaternionProduct(inverse, to_q, relative);
    ceres::QuaternionProduct(measured, relative, q);
    ceres::QuaternionToAngleAxis(q, w);

    const T theta2 = ceres::DotProduct(w, w);
    const T theta = ceres::sqrt(theta2 + 1e-30);
    const T c =
        theta2 < T(1e-8)
            ? T(1.0 / 12.0)
            : (1.0 - 0.5 * theta * ceres::cos(0.5 * theta) / ceres::sin(0.5 * theta)) / theta2;
    T wt[3], wwt[3];
    ceres::CrossProduct(w, t, wt);
    ceres::CrossProduct(w, wt, wwt);
    Eigen::Matrix<T, 6, 1> error;
    for (int i = 0; i < 3; ++i) {
      error[i] = t[i] - 0.5 * wt[i] + c * wwt[i];
      error[3 + i] = w[i];
    }
    Eigen::Map<Eigen::Matrix<T, 6, 1>> whitened(residual);
    whitened = root_.cast<T>() * error;
    return true;
  }

  bool prior() const { return prior_; }

 private:
  bool prior_;
  std::array<double, 4> measured_;
  std::array<double, 3> translation_;
  Matrix6d root_;
};

double independentOptimum(const PoseGraph& graph) {
  std::vector<std::array<double, 4>> q(graph.nodes().size());
  std::vector<std::array<double, 3>> t(graph.nodes().size());
  ceres::Problem problem;
  for (size_t i = 0; i < graph.nodes().size(); ++i) {
    const Pose3& pose = graph.nodes()[i].world_T_base;
    const Eigen::Quaterniond rotation(pose.linear());
    q[i] = {rotation.w(), rotation.x(), rotation.y(), rotation.z()};
    t[i] = {pose(0, 3), pose(1, 3), pose(2, 3)};
    problem.AddParameterBlock(q[i].data(), 4, new ceres::QuaternionManifold);
    problem.AddParameterBlock(t[i].data(), 3);
  }
  for (const Edge& edge : graph.edges()) {
    const size_t from = graph.place(edge.from), to = graph.place(edge.to);
    if (edge.type == EdgeType::kPrior)
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<AutoDiffEdge, 6, 4, 3>(new AutoDiffEdge(edge)), nullptr,
          q[to].data(), t[to].data());
    else
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<AutoDiffEdge, 6, 4, 3, 4, 3>(new AutoDiffEdge(edge)),
          nullptr, q[from].data(), t[from].data(), q[to].data(), t[to].data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.initial_trust_region_radius = 1e8;
  options.function_tolerance = 1e-9;
  options.max_num_iterations = 200;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.final_cost;
}

double rmse(const std::vector<Pose3>& poses, const std::vector<Pose3>& truth) {
  double sum = 0;
  for (size_t i = 0; i < poses.size(); ++i)
    sum += (poses[i].translation() - truth[i].translation()).squaredNorm();
  return std::sqrt(sum / static_cast<double>(poses.size()));
}

std::vector<Pose3> estimates(const PoseGraph& graph) {
  std::vector<Pose3> result;
  for (const Node& node : graph.nodes()) result.push_back(node.world_T_base);
  return result;
}

Node nodeAt(KeyframeId id, const Pose3& world_T_base = Pose3::Identity(), bool planar = false) {
  Node node;
  node.id = id;
  node.world_T_base = world_T_base;
  node.planar = planar;
  return node;
}

TEST(Lm, ReachesTheOptimumOfAnIndependentProblem) {
  const World world = makeWorld({});
  const OptimizationResult result = Lm().optimize(world.graph);
  ASSERT_TRUE(result.report.usable);
  EXPECT_NEAR(result.report.final_cost / independentOptimum(world.graph), 1.0, 1e-6);
  EXPECT_LT(result.report.final_cost, 0.1 * result.report.initial_cost);
}

TEST(Lm, ReachesTheOptimumOfParkingGarage) {
  if (dataFolder().empty()) GTEST_SKIP() << "no recordings: set LAMP_DATA to their folder";
  const PoseGraph graph = readG2o(dataFolder() + "/pose_graphs/parking-garage.g2o");
  ASSERT_EQ(graph.nodes().size(), 1661u);
  ASSERT_EQ(graph.edges().size(), 6276u);
  const OptimizationResult result = Lm().optimize(graph);
  EXPECT_NEAR(result.report.final_cost / independentOptimum(graph), 1.0, 1e-4);
  // 1.2688 is the published optimum of sum of squares with g2o's quaternion residual.
  EXPECT_NEAR(2 * result.report.final_cost, 1.2688, 0.05);
}

TEST(Lm, FindsTheTruth) {
  for (const bool planar : {false, true}) {
    WorldOptions options;
    options.planar = planar;
    const World world = makeWorld(options);
    const double before = rmse(estimates(world.graph), world.truth);
    const double after = rmse(Lm().optimize(world.graph).world_T_base, world.truth);
    EXPECT_GT(before, 0.3);
    EXPECT_LT(after, 0.15);
    EXPECT_LT(after, 0.3 * before);
  }
}

TEST(Lm, CostOfTheTrueModelIsHalfItsDegreesOfFreedom) {
  WorldOptions options;
  for (const int dof : {6, 3}) {
    options.planar = dof == 3;
    options.loops = 200;
    const World world = makeWorld(options);
    const double redundancy = dof * (static_cast<double>(world.graph.edges().size()) -
                                     static_cast<double>(world.truth.size()));
    EXPECT_NEAR(2 * Lm().optimize(world.graph).report.final_cost, redundancy,
                4 * std::sqrt(2 * redundancy));
  }
}

TEST(Lm, PlanarGraphsStayPlanar) {
  WorldOptions options;
  options.planar = true;
  for (const Pose3& pose : Lm().optimize(makeWorld(options).graph).world_T_base) {
    EXPECT_EQ(pose.translation().z(), 0.0);
    EXPECT_TRUE(pose.linear().col(2).isApprox(Eigen::Vector3d::UnitZ(), 1e-15));
  }
}

TEST(Lm, GivesTheSameBytesTwice) {
  const World world = makeWorld({});
  const OptimizationResult a = Lm().optimize(world.graph), b = Lm().optimize(world.graph);
  ASSERT_EQ(a.world_T_base.size(), b.world_T_base.size());
  for (size_t i = 0; i < a.world_T_base.size(); ++i)
    EXPECT_EQ(std::memcmp(a.world_T_base[i].data(), b.world_T_base[i].data(), 16 * sizeof(double)),
              0);
}

TEST(Lm, RejectedLoopsStayOut) {
  WorldOptions options;
  options.outliers = 20;
  World world = makeWorld(options);
  for (size_t e = 0; e < world.true_edge.size(); ++e)
    if (!world.true_edge[e]) world.graph.edges()[e].verdict = Verdict::kOutlier;
  const OptimizationResult result = Lm().optimize(world.graph);
  EXPECT_LT(rmse(result.world_T_base, world.truth), 0.15);
  ASSERT_EQ(result.loops.size(), 80u);
  for (const LoopVerdict& loop : result.loops) {
    const bool inlier = world.true_edge[loop.edge];
    EXPECT_EQ(loop.verdict, inlier ? Verdict::kInlier : Verdict::kOutlier);
    EXPECT_EQ(loop.weight, inlier ? 1.0 : 0.0);
    EXPECT_EQ(loop.chi2 < 50.0, inlier);
  }
  applyResult(result, world.graph);
  EXPECT_LT(rmse(estimates(world.graph), world.truth), 0.15);
}

TEST(Lm, EmptyGraphAndLoneNode) {
  PoseGraph graph;
  EXPECT_TRUE(Lm().optimize(graph).world_T_base.empty());
  const Pose3 current = planarPose(1, 2, 0.5);
  graph.addNode(nodeAt(keyframe(0, 0), current));
  const OptimizationResult alone = Lm().optimize(graph);
  ASSERT_TRUE(alone.report.usable) << alone.report.termination;
  EXPECT_TRUE(alone.world_T_base[0].isApprox(current, 1e-15));

  const Pose3 start = planarPose(4, 5, -1);
  graph.addEdge(
      makeEdge(EdgeType::kPrior, keyframe(0, 0), keyframe(0, 0), start, informationOf(0.1, 0.1)));
  EXPECT_TRUE(Lm().optimize(graph).world_T_base[0].isApprox(start, 1e-9));
}

TEST(Lm, ComponentsWithoutPriorKeepTheirFirstNode) {
  WorldOptions options;
  options.priors = false;
  options.loops = 0;
  World world = makeWorld(options);
  const KeyframeId second = keyframe(1, 0);
  const Pose3 current = planarPose(-7, 3, 1);
  world.graph.node(second).world_T_base = current;
  const OptimizationResult result = Lm().optimize(world.graph);
  ASSERT_TRUE(result.report.usable);
  EXPECT_TRUE(result.world_T_base[world.graph.place(second)].isApprox(current, 1e-15));
  EXPECT_LT(result.report.final_cost, 1e-9);  // odometry alone is met exactly
}

TEST(Lm, ParallelEdgesAddTheirInformation) {
  PoseGraph graph;
  for (int i : {0, 1}) graph.addNode(nodeAt(keyframe(0, i)));
  const auto add = [&](EdgeType type, double x, double sigma) {
    graph.addEdge(makeEdge(type, keyframe(0, 0), keyframe(0, 1), planarPose(x, 0, 0),
                           informationOf(sigma, 0.1)));
  };
  add(EdgeType::kOdometry, 1.0, 0.1);
  add(EdgeType::kLoopClosure, 2.0, 0.1);
  add(EdgeType::kLoopClosure, 2.0, 0.1);
  const OptimizationResult result = Lm().optimize(graph);
  EXPECT_NEAR(result.world_T_base[1].translation().x(), 5.0 / 3.0, 1e-6);
  EXPECT_EQ(result.loops.size(), 2u);
  EXPECT_NEAR(result.loops[0].chi2, 100.0 / 9.0, 1e-4);
}

TEST(Lm, LoopWithRankDeficientInformationCountsWhereItKnows) {
  PoseGraph graph;
  for (int i : {0, 1}) graph.addNode(nodeAt(keyframe(0, i)));
  graph.addEdge(makeEdge(EdgeType::kOdometry, keyframe(0, 0), keyframe(0, 1), planarPose(1, 0, 0),
                         informationOf(0.1, 1e-4)));
  Vector6d direction = Vector6d::Zero();
  direction.head<2>() << 1, 1;  // knows x + y only
  graph.addEdge(makeEdge(EdgeType::kLoopClosure, keyframe(0, 0), keyframe(0, 1),
                         planarPose(2, 0, 0), 1e6 * direction * direction.transpose()));
  const OptimizationResult result = Lm().optimize(graph);
  ASSERT_TRUE(result.report.usable);
  const Eigen::Vector3d t = result.world_T_base[1].translation();
  EXPECT_NEAR(t.x() + t.y(), 2.0, 1e-3);
  EXPECT_NEAR(t.x() - t.y(), 1.0, 1e-3);
  EXPECT_NEAR(t.z(), 0.0, 1e-9);
}

TEST(Lm, PoseThatIsNotFiniteIsNamed) {
  PoseGraph graph;
  Pose3 broken = Pose3::Identity();
  broken(0, 3) = std::numeric_limits<double>::quiet_NaN();
  graph.addNode(nodeAt(keyframe(0, 7), broken));
  try {
    Lm().optimize(graph);
    FAIL() << "nothing thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("key node 7"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lamp
