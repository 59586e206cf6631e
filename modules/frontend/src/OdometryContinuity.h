#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "lamp/input/OdometryFromObservation.h"

namespace lamp {

/** Continues odometry over restarts and leaves out single readings that are astray.
 *
 * A step is out of the ordinary if it is much longer than those before it, and than a robot drives
 * in that time, or if it leads exactly back to the first pose, as a driver does that was started
 * anew. The reading after it tells which: if that goes on from before the step, the one between was
 * astray; if it goes on from behind the step, odometry has begun anew, and continues here at the
 * speed that the robot had. */
class OdometryContinuity {
 public:
  /** A motion that odometry did not measure; its standard deviations. */
  struct Restart {
    double begin = 0, end = 0;  ///< seconds, UTC
    double sigma_m = 0, sigma_rad = 0;
  };

  /** \param reading as recorded, in time order.
   *  \return those that are beyond doubt now, in the frame of the first one. */
  std::vector<OdometryReading> take(const OdometryReading& reading);

  const std::vector<Restart>& restarts() const { return restarts_; }
  size_t astray() const { return astray_; }

 private:
  struct Step {
    double seconds = 0, length_m = 0, angle_rad = 0;
  };

  static Step between(const OdometryReading& from, const OdometryReading& to);
  bool ordinary(const Step& step) const;
  bool returnsToStart(const OdometryReading& reading) const;
  OdometryReading accept(const OdometryReading& reading);
  void restartAt(const OdometryReading& reading);
  Pose3 likelyMotion(double seconds) const;

  std::optional<OdometryReading> first_, last_;  ///< accepted, as recorded
  std::optional<OdometryReading> doubtful_;
  std::deque<Step> steps_;                 ///< the last ordinary ones
  Pose3 last_motion_ = Pose3::Identity();  ///< of the last of them
  Pose3 odom_T_recorded_ = Pose3::Identity();
  bool restarted_ = false;  ///< the next reading follows no step that was measured
  std::vector<Restart> restarts_;
  size_t astray_ = 0;
};

}  // namespace lamp
