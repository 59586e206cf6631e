#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ClockOffset.h"
#include "lamp/core/KeyNodePacket.h"
#include "lamp/frontend/OdometrySource.h"

namespace lamp {

/** What is wrong with recorded odometry, as far as lidar odometry shows it: it says nothing of some
 * time, its clock is another one, or it stands while the lidar moves. This changes no pose; it
 * tells the user what to look for. */
class OdometryComparison {
 public:
  /** The scans in time order. \param scan `odom_T_base` by the lidar. */
  void observe(const StampedPose& scan, OdometrySource& recorded);
  /** What a user should know, in words. */
  std::vector<std::string> warnings() const;

 private:
  struct Occurrence {
    double seconds = 0;           ///< in all
    std::optional<double> first;  ///< stamp, seconds, UTC

    void add(double begin, double duration);
  };

  void watchStanding(double begin, double end, bool stands);

  ClockOffset clock_;
  std::optional<StampedPose> last_;
  bool known_ = false;
  Occurrence unknown_, standing_;
  Occurrence stands_now_;
};

}  // namespace lamp
