#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "lamp/core/KeyNodePacket.h"
#include "lamp/frontend/OdometrySource.h"

namespace lamp {

/** Measures how far the clock of another odometry source is off that of the lidar, where the robot
 * turns: both turn alike, but the one later than the other.
 *
 * The rotation between two scans is compared with that of the other source between the same two
 * moments, moved by each of many offsets; the one that makes the sum of squared differences
 * smallest is sought. A robot that never turns, or always evenly, tells nothing. */
class ClockOffset {
 public:
  ClockOffset();

  /** The motion between two scans. \param previous, scan `odom_T_base` by the lidar; stamps in
   * seconds, UTC. \param other what it has observed decides when the motion can be compared. */
  void observe(const StampedPose& previous, const StampedPose& scan, OdometrySource& other);

  /** Seconds that the other source's stamps are later than the lidar's for the same motion; none
   * if nothing tells. */
  std::optional<double> seconds() const;
  /** The same, if stamps as they are fit clearly worse and the difference matters. */
  std::optional<double> wrong() const;

 private:
  struct Step {
    double begin = 0, end = 0;  ///< seconds, UTC
    Pose3 motion = Pose3::Identity();
  };

  void compare(const Step& step, OdometrySource& other);

  std::deque<Step> waiting_;     ///< for the other source
  std::vector<double> squares_;  ///< rad², sum of the squared differences for each offset
  double turned_rad_ = 0;
};

}  // namespace lamp
