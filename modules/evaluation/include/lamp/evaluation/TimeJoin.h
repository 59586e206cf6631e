#pragma once

#include <string>
#include <vector>

#include "lamp/evaluation/Truth.h"

namespace lamp::evaluation {

/** An estimated pose and the true one at its stamp. */
struct JoinedPose {
  double stamp = 0;
  Pose3 estimate = Pose3::Identity();  ///< estimate_T_base
  Pose3 truth = Pose3::Identity();     ///< truth_T_base
  size_t row = 0;                      ///< place in the estimated trajectory
};

/** An estimated trajectory joined with the truth in time. */
struct JoinedTrajectory {
  std::vector<JoinedPose> poses;
  size_t estimated = 0;       ///< poses in the estimated trajectory
  size_t true_poses = 0;      ///< in the true trajectory
  size_t true_poses_met = 0;  ///< of those, how many lie within the estimate's time span
};

/** Poses at stamps that the truth does not cover are left out.
 * \throws std::runtime_error naming the robot and both time spans if nothing is left. */
JoinedTrajectory joinInTime(const std::vector<StampedPose>& estimate, const TrueTrajectory& truth,
                            const std::string& robot);

}  // namespace lamp::evaluation
