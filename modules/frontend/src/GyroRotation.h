#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "lamp/frontend/OdometrySource.h"
#include "lamp/input/ObservationSource.h"

namespace lamp {

/** Whether two rotations cannot both be right. */
bool contradict(const MeasuredRotation& a, const MeasuredRotation& b);

/** How a robot turns, by the gyros of its inertial unit. Their bias follows from how the lidar sees
 * it turn; a unit that contradicts the lidar again and again (mounted otherwise than the recording
 * says, a clock of its own) is not used any more. */
class GyroRotation {
 public:
  /** Takes the robot's observations; those of other sensors are ignored. */
  void observe(const InputObservation& observation);
  /** True once readings reach `stamp` (seconds, UTC), or if none are to be waited for. */
  bool covers(double stamp) const;
  /** The rotation between two moments; none if readings are missing, or not to be believed. */
  std::optional<MeasuredRotation> between(double from, double to) const;
  /** How the robot stood at a stamp by the lidar alone, in a frame that stays the same. */
  void compare(double stamp, const MeasuredRotation& seen);
  std::vector<std::string> warnings() const;

 private:
  static constexpr double kBias = 0.02;  ///< rad/s, of an inexpensive unit at the start

  struct Reading {
    double stamp;
    Eigen::Vector3d rate;  ///< rad/s, base frame
  };

  struct Seen {
    double stamp;
    MeasuredRotation orientation;
  };

  std::optional<MeasuredRotation> integrated(double from, double to) const;
  void noteContradiction(bool contradicts, double stamp);

  std::optional<std::string> label_;  ///< of the unit that was heard first
  std::deque<Reading> readings_;
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();  ///< rad/s
  double bias_variance_ = kBias * kBias;
  std::optional<Seen> compared_;    ///< from there on the next comparison counts
  std::deque<bool> contradicted_;   ///< in the last comparisons that could tell
  std::optional<double> given_up_;  ///< stamp, seconds, UTC
};

}  // namespace lamp
