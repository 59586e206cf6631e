#include "lamp/frontend/StartPose.h"

#include <cmath>

namespace lamp {

namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kOtherSigmaM = 0.5, kOtherSigmaRad = 5.0 * kDegree;

/** Standard deviations of LAMP's prior on the first node: x y z, roll pitch, yaw. */
Vector6d tightSigmas() {
  Vector6d sigmas;
  sigmas << 0.0016, 0.0016, 0.0016, 0.041, 0.041, 0.00041;
  return sigmas;
}

}  // namespace

std::optional<StartPrior> startPrior(const RobotOptions& robot, bool first) {
  if (robot.start_pose.empty()) return std::nullopt;
  Vector6d pose = Eigen::Map<const Vector6d>(robot.start_pose.data());
  pose.tail<3>() *= kDegree;

  Vector6d sigmas = tightSigmas();
  if (!first) {
    sigmas.head<3>().setConstant(kOtherSigmaM);
    sigmas.tail<3>().setConstant(kOtherSigmaRad);
  }
  if (robot.start_sigma_xyz_m > 0) sigmas.head<3>().setConstant(robot.start_sigma_xyz_m);
  if (robot.start_sigma_rot_deg > 0)
    sigmas.tail<3>().setConstant(robot.start_sigma_rot_deg * kDegree);

  StartPrior prior;
  prior.world_T_base = poseFromYawPitchRoll(pose);
  prior.covariance = sigmas.cwiseAbs2().asDiagonal();
  return prior;
}

}  // namespace lamp
