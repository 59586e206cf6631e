#include "lamp/simulation/Mission.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "SmallMission.h"

namespace lamp::simulation {
namespace {

using namespace test;
using Places = std::vector<size_t>;

std::vector<StampedPose> steps(size_t count, const Vector6d& step) {
  std::vector<StampedPose> poses(1);
  while (poses.size() < count)
    poses.push_back({static_cast<double>(poses.size()), poses.back().pose * expSE3(step)});
  return poses;
}

Vector6d twist(double x, double yaw_deg) {
  return (Vector6d() << x, 0, 0, 0, 0, yaw_deg * M_PI / 180).finished();
}

TEST(SelectKeyNodes, ByDistance) {
  EXPECT_EQ(selectKeyNodes(steps(12, twist(0.5, 0)), {}), (Places{0, 4, 8}));
  EXPECT_EQ(selectKeyNodes(steps(12, twist(0, 0)), {}), (Places{0})) << "it stands";
}

TEST(SelectKeyNodes, ByAngle) {
  EXPECT_EQ(selectKeyNodes(steps(9, twist(0, 11)), {}), (Places{0, 3, 6}));
  EXPECT_EQ(selectKeyNodes(steps(9, twist(0, -11)), {}), (Places{0, 3, 6}));
}

TEST(SelectKeyNodes, SinceTheLastKeyNodeOnly) {
  auto there_and_back = steps(4, twist(0.6, 0));
  for (int i = 2; i >= 0; --i) there_and_back.push_back(there_and_back[static_cast<size_t>(i)]);
  EXPECT_EQ(selectKeyNodes(there_and_back, {}), (Places{0})) << "never 2 m away";
}

TEST(SelectKeyNodes, OfFewPoses) {
  EXPECT_EQ(selectKeyNodes({}, {}), Places());
  EXPECT_EQ(selectKeyNodes(steps(1, twist(0, 0)), {}), (Places{0}));
}

TEST(Mission, RobotsStartOneAfterTheOtherAtTheGate) {
  const Mission& mission = SmallMission::shared().mission;
  ASSERT_EQ(mission.robots.size(), 2u);
  EXPECT_EQ(mission.robots[0].name, "alpha");
  EXPECT_EQ(mission.robots[1].name, "bravo");
  EXPECT_NEAR(mission.robots[1].truth.begin() - mission.robots[0].truth.begin(), 5, 1e-6);
  for (const MissionRobot& robot : mission.robots)
    EXPECT_LT(robot.truth.at(robot.truth.begin()).translation().norm(), 0.5);
}

TEST(Mission, ScansComeAtTheRateOfTheLeadingLidarAndEndBeforeTheTruth) {
  for (const MissionRobot& robot : SmallMission::shared().mission.robots) {
    const std::vector<double> stamps = robot.scanStamps();
    ASSERT_GT(stamps.size(), 300u);
    for (size_t i = 1; i < stamps.size(); ++i) EXPECT_NEAR(stamps[i] - stamps[i - 1], 0.1, 1e-5);
    EXPECT_LE(stamps.back() + 0.1, robot.truth.end() + 1e-6);
    EXPECT_GE(robot.odometry.odom_T_base.back().stamp, stamps.back() + 0.1 - 1e-5)
        << "odometry covers the last sweep";
    EXPECT_NEAR(static_cast<double>(robot.imu.size()),
                100 * (robot.truth.end() - robot.truth.begin()), 2);
  }
}

TEST(Mission, KeyNodesAreDueByOdometry) {
  for (const MissionRobot& robot : SmallMission::shared().mission.robots) {
    const auto& odometry = robot.odometry.odom_T_base;
    ASSERT_GT(robot.key_nodes.size(), 20u);
    const auto isDue = [&](size_t from, size_t to) {
      const Pose3 motion = odometry[from].pose.inverse() * odometry[to].pose;
      return motion.translation().norm() >= 2 || rotationAngle(motion) >= M_PI / 6;
    };
    EXPECT_EQ(robot.key_nodes[0], 0u);
    for (size_t i = 1; i < robot.key_nodes.size(); ++i) {
      const size_t last = robot.key_nodes[i - 1], here = robot.key_nodes[i];
      EXPECT_TRUE(isDue(last, here));
      for (size_t k = last + 1; k < here; ++k) EXPECT_FALSE(isDue(last, k));
      EXPECT_EQ(robot.stampOf(i), odometry[here].stamp);
    }
  }
}

TEST(Mission, KeyNodesReachTheBaseAfterTheirStampsAndInOrder) {
  for (const MissionRobot& robot : SmallMission::shared().mission.robots) {
    ASSERT_EQ(robot.arrivals.size(), robot.key_nodes.size());
    EXPECT_TRUE(std::is_sorted(robot.arrivals.begin(), robot.arrivals.end()));
    for (size_t i = 0; i < robot.arrivals.size(); ++i)
      EXPECT_GE(robot.arrivals[i], robot.stampOf(i));
  }
}

TEST(Mission, OdometryIsNoBetterThanThePaperSays) {
  const SmallMission& small = SmallMission::shared();
  for (size_t i = 0; i < small.mission.robots.size(); ++i) {
    const MissionRobot& robot = small.mission.robots[i];
    const Pose3 world_T_odom = robot.truth.at(robot.odometry.odom_T_base.front().stamp);
    double sum = 0;
    for (const StampedPose& pose : robot.odometry.odom_T_base)
      sum += ((world_T_odom * pose.pose).translation() - robot.truth.at(pose.stamp).translation())
                 .norm();
    const double ate = sum / static_cast<double>(robot.odometry.odom_T_base.size());
    EXPECT_GE(ate, 0.95 * small.config.robots[i].odometry.min_ate_m);
    EXPECT_LT(ate, 3) << "of 60 m";
  }
}

TEST(Mission, TheSeedDecidesTheMission) {
  SimConfig config = configOf("demo", "[world]\ncell_m = 0.4\n");
  for (SimulatedRobotOptions& robot : config.robots) robot.length_m = 20;
  const World world = config.kind->make(150, 0.4, 3);
  const RayCaster caster(world.mesh);
  const Mission one = makeMission(config, world, caster, 4),
                same = makeMission(config, world, caster, 4),
                other = makeMission(config, world, caster, 5);
  const auto end = [](const Mission& mission) {
    return mission.robots[1].odometry.odom_T_base.back().pose.matrix();
  };
  EXPECT_TRUE(end(one) == end(same));
  EXPECT_FALSE(end(one) == end(other));
}

}  // namespace
}  // namespace lamp::simulation
