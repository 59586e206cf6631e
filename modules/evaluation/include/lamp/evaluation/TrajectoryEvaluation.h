#pragma once

#include <string>
#include <vector>

#include "lamp/evaluation/Alignment.h"
#include "lamp/evaluation/RunFiles.h"
#include "lamp/evaluation/TrajectoryError.h"

namespace lamp::evaluation {

/** One trajectory against the truth, or several together. */
struct TrajectoryScore {
  TrajectoryError error;
  Drift drift_10m, drift_100m;
  size_t estimated = 0, joined = 0;           ///< poses of the run; of those, with a true one
  size_t true_poses = 0, true_poses_met = 0;  ///< of the truth; of those, within the run's time

  void append(const TrajectoryScore& other);
};

struct RobotEvaluation {
  std::string name;
  size_t component = 0;
  bool planar = false;
  std::vector<JoinedPose> poses, odometry_poses;
  Pose3 truth_T_world = Pose3::Identity();  ///< the alignment of the result
  Pose3 truth_T_odom = Pose3::Identity();   ///< the same kind of alignment, of the odometry
  double mean_true_height_m = 0;            ///< z of the true positions, of planar robots too
  TrajectoryScore result, odometry;
};

struct TrajectoryEvaluation {
  Alignment alignment = Alignment::kNone;
  std::vector<RobotEvaluation> robots;  ///< those that the truth knows
  TrajectoryScore result, odometry;     ///< over all scans of all robots
  std::vector<std::string> warnings;
};

/** Robots that only the run or only the truth knows are named in a warning; scans of the latter
 * count as not met. Planar robots are compared in the plane.
 * \throws std::runtime_error if no robot is in both, if one has no scan at a time that its truth
 * covers, or if the true trajectories of two robots seem to be exchanged. */
TrajectoryEvaluation evaluateTrajectories(const RunFiles& run, const TruthFolder& truth,
                                          Alignment alignment);

}  // namespace lamp::evaluation
