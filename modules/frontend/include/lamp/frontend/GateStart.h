#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "lamp/frontend/GateCalibration.h"
#include "lamp/input/ObservationSource.h"
#include "lamp/input/ScanFromObservation.h"

namespace lamp {

/** Gives a robot's first key node the pose that the gate tells (paper II-A). Key nodes wait until
 * the robot has stood long enough, or moves; this takes no longer than `[gate] standing_s`, or
 * until a key node elsewhere.
 *
 * Odometry tells when the robot moves. Without any, it has to stand for the whole time: what is
 * seen of the plates is blurred else, and refused. */
class GateStart {
 public:
  GateStart(const GateOptions& gate, const ScanOptions& scan);

  /** Takes the robot's observations in time order. */
  void observe(const InputObservation& observation);
  /** \param packets of the robot's front end, in its order. \return those that need not wait. */
  std::vector<KeyNodePacket> pass(std::vector<KeyNodePacket> packets);
  /** No more observations will come. \return the key nodes that still wait. */
  std::vector<KeyNodePacket> finish();
  /** What a user should know, in words. */
  std::vector<std::string> warnings() const;

 private:
  bool hasMoved(const InputObservation& observation);
  void takeUpTo(double stamp);
  void decide();

  const GateOptions gate_;
  const ScanOptions scan_;
  GateCalibration calibration_;
  std::deque<InputObservation> recent_;  ///< in which the robot may be setting off
  std::optional<double> begin_;          ///< stamp of the first scan
  std::optional<Pose3> odom_T_start_;
  size_t scans_ = 0;
  std::optional<GateResult> result_;
  std::vector<KeyNodePacket> waiting_;
};

}  // namespace lamp
