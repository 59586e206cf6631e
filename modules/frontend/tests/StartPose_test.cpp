#include "lamp/frontend/StartPose.h"

#include <gtest/gtest.h>

#include <cmath>

#include "TestObservations.h"

namespace lamp {
namespace {

using namespace test;

RobotOptions startingAt(const std::vector<double>& pose) {
  RobotOptions robot;
  robot.start_pose = pose;
  return robot;
}

Vector6d sigmas(const StartPrior& prior) {
  return prior.covariance.diagonal().cwiseSqrt();
}

TEST(StartPrior, IsNoneWithoutAStartPose) {
  EXPECT_FALSE(startPrior(RobotOptions{}, true));
  EXPECT_FALSE(startPrior(RobotOptions{}, false));
}

TEST(StartPrior, ReadsYawPitchRollInDegrees) {
  const auto prior = startPrior(startingAt({1, 2, 3, 90, 0, 0}), true);
  ASSERT_TRUE(prior);
  // The robot looks along y: a point 1 m ahead of it lies at (1, 3, 3).
  EXPECT_LT((prior->world_T_base * Eigen::Vector3d::UnitX() - Eigen::Vector3d(1, 3, 3)).norm(),
            1e-12);
  // A pitch of 90 degrees looks down, a roll of 90 degrees turns left to up.
  const auto pitched = startPrior(startingAt({0, 0, 0, 0, 90, 0}), true);
  EXPECT_LT((pitched->world_T_base * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitZ()).norm(),
            1e-12);
  const auto rolled = startPrior(startingAt({0, 0, 0, 0, 0, 90}), true);
  EXPECT_LT((rolled->world_T_base * Eigen::Vector3d::UnitY() - Eigen::Vector3d::UnitZ()).norm(),
            1e-12);
}

TEST(StartPrior, TiesTheFirstRobotAndLeavesTheOthersRoom) {
  const RobotOptions robot = startingAt({0, 0, 0, 30, 0, 0});
  const Vector6d first = sigmas(*startPrior(robot, true));
  EXPECT_LT(first.head<3>().maxCoeff(), 0.01);
  EXPECT_LT(first.tail<3>().maxCoeff(), 0.05);
  EXPECT_LT(first[5], 0.001) << "yaw swings the whole map";
  const Vector6d other = sigmas(*startPrior(robot, false));
  EXPECT_LT((other.head<3>().array() - 0.5).abs().maxCoeff(), 1e-12);
  EXPECT_LT((other.tail<3>().array() - 5 * kDegree).abs().maxCoeff(), 1e-12);
}

TEST(StartPrior, TheInisSigmasHoldForAnyRobot) {
  RobotOptions robot = startingAt({0, 0, 0, 0, 0, 0});
  robot.start_sigma_xyz_m = 0.2;
  for (const bool first : {true, false}) {
    const Vector6d position_given = sigmas(*startPrior(robot, first));
    EXPECT_LT((position_given.head<3>().array() - 0.2).abs().maxCoeff(), 1e-12);
    EXPECT_EQ(position_given.tail<3>(),
              sigmas(*startPrior(startingAt({0, 0, 0, 0, 0, 0}), first)).tail<3>())
        << "the rotation's default stays";
  }
  robot.start_sigma_rot_deg = 12;
  for (const bool first : {true, false})
    EXPECT_LT((sigmas(*startPrior(robot, first)).tail<3>().array() - 12 * kDegree).abs().maxCoeff(),
              1e-12);
}

}  // namespace
}  // namespace lamp
