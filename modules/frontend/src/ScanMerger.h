#pragma once

#include <functional>
#include <string>

#include "lamp/core/Geometry.h"
#include "lamp/core/KeyedScan.h"
#include "lamp/frontend/ScanAssembler.h"
#include "lamp/input/ScanFromObservation.h"

namespace lamp {

/** Makes one scan of what several lidars saw: all points in the base frame at the scan's stamp.
 * While a lidar turns, the robot moves on: where points have times, each is put where the robot
 * stood then. */
class ScanMerger {
 public:
  /** `from_T_to`: the robot's motion between two stamps, seconds, UTC. */
  using Motion = std::function<Pose3(double from, double to)>;

  explicit ScanMerger(const ScanOptions& options) : options_(options) {}

  Scan merge(const ScanParts& parts, const Motion& motion);
  /** How long the last scan took, seconds; zero if its points have no times. */
  double sweep() const { return sweep_s_; }
  /** Scans whose external file could not be read, and why the first one could not. */
  size_t unreadable() const { return unreadable_; }
  const std::string& firstUnreadable() const { return first_unreadable_; }

 private:
  const ScanOptions options_;
  double sweep_s_ = 0;
  size_t unreadable_ = 0;
  std::string first_unreadable_;
};

}  // namespace lamp
