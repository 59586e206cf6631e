#pragma once

#include <deque>
#include <map>
#include <string>
#include <variant>

#include "lamp/core/KeyNodePacket.h"
#include "lamp/frontend/GravityDetector.h"
#include "lamp/frontend/OdometrySource.h"

namespace lamp {

/** Gathers what a robot measures between key nodes, and carries it to them by odometry. */
class ExtrasCollector {
 public:
  explicit ExtrasCollector(const GravityOptions& gravity) : gravity_detector_(gravity) {}

  /** Observations in time order; those that it has no use for are ignored. */
  void observe(const InputObservation& observation);
  /** What was measured up to `stamp` is carried to the odometry frame; what odometry does not cover
   * is dropped. */
  void advanceTo(double stamp, OdometrySource& odometry);
  /** What is there, in the frame of a key node; it is forgotten then. */
  KeyNodeExtras take(const Pose3& odom_T_base);

 private:
  using Reading = std::variant<LandmarkSighting, RangeReading, GravityReading>;

  void place(const LandmarkSighting& sighting);
  void place(const RangeReading& range) { ranges_[range.beacon] = range; }
  void place(const GravityReading& gravity) { gravity_ = gravity; }

  GravityDetector gravity_detector_;
  std::deque<Reading> waiting_;  ///< in the base frame at their stamps
  /** In the odometry frame; ordered, so that packets do not depend on anything else. */
  std::map<std::string, LandmarkSighting> sightings_;
  std::map<int, RangeReading> ranges_;
  std::optional<GravityReading> gravity_;
};

}  // namespace lamp
