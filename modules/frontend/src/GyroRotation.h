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
bool contradict(const RotationPrior& a, const RotationPrior& b);

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
  std::optional<RotationPrior> between(double from, double to) const;
  /** What the lidar saw of the same rotation. */
  void compare(double from, double to, const RotationPrior& seen);
  std::vector<std::string> warnings() const;

 private:
  static constexpr double kBias = 0.02;  ///< rad/s, of an inexpensive unit at the start

  struct Reading {
    double stamp;
    Eigen::Vector3d rate;  ///< rad/s, base frame
  };

  std::optional<RotationPrior> integrated(double from, double to) const;

  std::optional<std::string> label_;  ///< of the unit that was heard first
  std::deque<Reading> readings_;
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();  ///< rad/s
  double bias_variance_ = kBias * kBias;
  std::deque<bool> contradicted_;   ///< in the last comparisons that could tell
  std::optional<double> given_up_;  ///< stamp, seconds, UTC
};

}  // namespace lamp
