#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lamp/core/Trajectory.h"

namespace lamp::evaluation {

/** The folder with the true trajectories and surface: `<robot>.tum`, `map.ply`. */
class TruthFolder {
 public:
  /** \param root holds the files, or a subfolder `truth` that does.
   *  \throws std::runtime_error if there is no `*.tum` in either. */
  explicit TruthFolder(const std::string& root);

  const std::string& root() const { return root_; }
  /** Names, sorted. */
  const std::vector<std::string>& robots() const { return robots_; }
  bool has(const std::string& robot) const;
  std::string trajectory(const std::string& robot) const { return root_ + "/" + robot + ".tum"; }
  std::string map() const { return root_ + "/map.ply"; }

 private:
  std::string root_;
  std::vector<std::string> robots_;
};

/** True pose at any stamp that the truth covers. */
class TrueTrajectory {
 public:
  /** \param poses sorted by stamp, not empty. \param planar drops z, roll and pitch, to be compared
   *  with a robot that is mapped in the plane. */
  explicit TrueTrajectory(std::vector<StampedPose> poses, bool planar = false);

  double begin() const { return poses_.front().stamp; }
  double end() const { return poses_.back().stamp; }
  const std::vector<StampedPose>& poses() const { return poses_; }
  /** Interpolated; none before the first pose, after the last one, or between two poses that lie
   * more than kMaxGap apart. */
  std::optional<Pose3> at(double stamp) const;

  static constexpr double kMaxGap = 1.0;      ///< seconds
  static constexpr double kSameStamp = 1e-4;  ///< seconds; files keep six decimals

 private:
  std::vector<StampedPose> poses_;
  TrajectoryInterpolator interpolator_;
};

}  // namespace lamp::evaluation
