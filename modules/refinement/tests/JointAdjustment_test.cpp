#include "lamp/refinement/JointAdjustment.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "TestSurfaces.h"

namespace lamp {
namespace {

/** Two robots that drive through a hall, whose poses are known to a few centimetres. */
struct Drive {
  PoseGraph graph;
  std::vector<KeyedScanPtr> scans;
  std::vector<Pose3> truth;

  explicit Drive(const test::Box& box, bool planar = false) {
    std::mt19937 random(7);
    for (uint16_t robot = 0; robot < 2; ++robot)
      for (uint32_t i = 0; i < 10; ++i) {
        const Pose3 pose = Eigen::Translation3d(1.5 + i, 2.0 + 2 * robot, 1.0) *
                           Pose3(Eigen::AngleAxisd(0.4 * i, Eigen::Vector3d::UnitZ()));
        add({RobotId{robot}, i}, pose, test::disturbed(pose, 0.05, 0.01, random), planar);
        scans.push_back(box.scan(pose, robot * 100 + i));
      }
    Edge between = edge(EdgeType::kLoopClosure, {RobotId{0}, 0}, {RobotId{1}, 0}, 0.05, 0.01);
    graph.addEdge(between);
  }

  Edge edge(EdgeType type, KeyNodeId from, KeyNodeId to, double sigma_m, double sigma_rad) const {
    Edge edge;
    edge.type = type;
    edge.from = from;
    edge.to = to;
    edge.from_T_to = type == EdgeType::kPrior
                         ? graph.node(from).world_T_base
                         : graph.node(from).world_T_base.inverse() * graph.node(to).world_T_base;
    edge.information.setZero();
    edge.information.diagonal().head<3>().setConstant(1 / (sigma_m * sigma_m));
    edge.information.diagonal().tail<3>().setConstant(1 / (sigma_rad * sigma_rad));
    return edge;
  }
  void add(KeyNodeId id, const Pose3& pose, const Pose3& estimate, bool planar) {
    Node node;
    node.id = id;
    node.planar = planar;
    node.world_T_base = truth.empty() ? pose : estimate;
    truth.push_back(pose);
    graph.addNode(node);
    if (truth.size() == 1) graph.addEdge(edge(EdgeType::kPrior, id, id, 1e-3, 1e-4));
    if (id.index > 0)
      graph.addEdge(edge(EdgeType::kOdometry, {id.robot, id.index - 1}, id, 0.07, 0.015));
  }
  double error(const std::vector<Pose3>& poses) const {
    double sum = 0;
    for (size_t i = 0; i < poses.size(); ++i)
      sum += (poses[i].translation() - truth[i].translation()).squaredNorm();
    return std::sqrt(sum / static_cast<double>(poses.size()));
  }
  std::vector<Pose3> estimates() const {
    std::vector<Pose3> poses;
    for (const Node& node : graph.nodes()) poses.push_back(node.world_T_base);
    return poses;
  }
};

const test::Box kHall{{0.0, 0.0, 0.0}, {13.0, 6.5, 3.2}};
const auto kGoOn = [](double) { return true; };

bool same(const std::vector<Pose3>& a, const std::vector<Pose3>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Pose3& x, const Pose3& y) { return x.matrix() == y.matrix(); });
}

TEST(JointAdjustment, BringsPosesNearerToTheTruth) {
  const Drive drive(kHall);
  const auto result = adjustJointly(drive.graph, drive.scans, {}, kGoOn);
  EXPECT_TRUE(result.report.kept);
  EXPECT_LT(result.report.after.rms_m, 0.5 * result.report.before.rms_m);
  EXPECT_GT(result.report.after.patches, 500u);
  EXPECT_LT(drive.error(result.world_T_base), 0.15 * drive.error(drive.estimates()));
}

TEST(JointAdjustment, AlongACorridorOdometryIsKept) {
  test::Box corridor = kHall;
  corridor.min.x() = -30;
  corridor.max.x() = 43;
  const Drive drive(corridor);
  const auto result = adjustJointly(drive.graph, drive.scans, {}, kGoOn);
  EXPECT_TRUE(result.report.kept);
  for (size_t i = 0; i < drive.truth.size(); ++i) {
    const Eigen::Vector3d before = drive.graph.nodes()[i].world_T_base.translation(),
                          after = result.world_T_base[i].translation();
    EXPECT_NEAR(after.x(), before.x(), 0.04) << i;
    EXPECT_NEAR(after.y(), drive.truth[i].translation().y(), 0.02) << i;
  }
}

TEST(JointAdjustment, TheSameBytesForAnyNumberOfThreads) {
  const Drive drive(kHall);
  const auto with = [&](size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return adjustJointly(drive.graph, drive.scans, {}, kGoOn).world_T_base;
  };
  EXPECT_TRUE(same(with(1), with(2)));
}

TEST(JointAdjustment, IsUndoneWhereSurfacesHeldBackComeNoNearer) {
  Drive drive(kHall);
  const auto once = adjustJointly(drive.graph, drive.scans, {}, kGoOn);
  // From the best poses each step is chance.
  for (size_t i = 0; i < drive.truth.size(); ++i)
    drive.graph.node(drive.graph.nodes()[i].id).world_T_base = once.world_T_base[i];
  RefinementOptions options;
  options.max_rounds = 20;
  const auto again = adjustJointly(drive.graph, drive.scans, options, kGoOn);
  EXPECT_LT(again.report.rounds, 20);
  EXPECT_LE(again.report.after.rms_m, again.report.before.rms_m);
  EXPECT_EQ(again.report.kept, !same(again.world_T_base, once.world_T_base));
}

TEST(JointAdjustment, RobotsThatNothingJoinsAreNotTied) {
  Drive drive(kHall);
  drive.graph.edges().back().verdict = Verdict::kOutlier;
  const auto apart = adjustJointly(drive.graph, drive.scans, {}, kGoOn);
  drive.graph.edges().back().verdict = Verdict::kInlier;
  const auto joined = adjustJointly(drive.graph, drive.scans, {}, kGoOn);
  EXPECT_LT(apart.report.pairs, joined.report.pairs);
}

TEST(JointAdjustment, LeavesPosesWhereThereIsNothingToAdjust) {
  const Drive planar(kHall, true);
  EXPECT_TRUE(
      same(adjustJointly(planar.graph, planar.scans, {}, kGoOn).world_T_base, planar.estimates()));
  const Drive drive(kHall);
  const auto stopped = adjustJointly(drive.graph, drive.scans, {}, [](double) { return false; });
  EXPECT_FALSE(stopped.report.kept);
  EXPECT_TRUE(same(stopped.world_T_base, drive.estimates()));
  const std::vector<KeyedScanPtr> empty(drive.scans.size(), std::make_shared<Scan>());
  EXPECT_TRUE(same(adjustJointly(drive.graph, empty, {}, kGoOn).world_T_base, drive.estimates()));
  EXPECT_TRUE(adjustJointly({}, {}, {}, kGoOn).world_T_base.empty());
}

}  // namespace
}  // namespace lamp
