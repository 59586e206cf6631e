#pragma once

#include <functional>
#include <optional>

#include "lamp/core/Geometry.h"
#include "lamp/core/KeyedScan.h"
#include "lamp/scans/PreparedScan.h"

namespace lamp {

/** Finds out when odometry says that a robot stands, while its lidar moves: an encoder or a driver
 * that failed.
 *
 * While odometry stands, scans are compared with the one from its beginning. Where most ranges have
 * stayed as they were, the robot stands; else the scans are aligned, since something else may have
 * moved. Two alignments in a row that say so are believed. */
class StandstillCheck {
 public:
  /** \param interval_s between looks at scans, as each costs time. */
  explicit StandstillCheck(double interval_s) : interval_s_(interval_s) {}

  /** Takes all scans in time order. \param scan makes it, if it is needed, in the base frame.
   *  \return true if the pose is that of a standstill which the lidar contradicts. */
  bool contradicts(double stamp, const Pose3& odom_T_base, const std::function<Scan()>& scan);

  /** When the standstill began, seconds, UTC: nothing is known from then on. */
  double begin() const { return begin_; }
  /** How fast the robot moved on average until the contradiction was found, m/s. */
  double speed() const { return speed_; }

 private:
  struct Look {
    double stamp = 0;
    Scan scan;
    PreparedScanPtr prepared;  ///< made when first needed
  };

  void look(double stamp, Scan scan);
  double motionSince(Look& reference, const Scan& scan) const;

  const double interval_s_;
  double begin_ = 0;
  std::optional<Pose3> pose_;  ///< of the standstill
  std::optional<Look> reference_;
  double last_look_ = 0;
  int votes_ = 0;
  bool contradicted_ = false;
  double speed_ = 0;
};

}  // namespace lamp
