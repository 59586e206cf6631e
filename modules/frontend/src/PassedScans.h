#pragma once

#include <vector>

#include "lamp/core/KeyNodePacket.h"

namespace lamp {

/** Where the robot was at the scans since its last key node. A robot that stands for an hour must
 * not fill the memory: of a standstill the first scans are kept, and the last one. */
class PassedScans {
 public:
  /** The scans in time order, `odom_T_base`. */
  void add(const StampedPose& scan);
  /** Forgets those from `stamp` on. \return how many. */
  size_t dropFrom(double stamp);
  /** All; none are left. */
  std::vector<StampedPose> take();

 private:
  std::vector<StampedPose> scans_;
  size_t standstill_ = 0;  ///< the first scan at the present place
};

}  // namespace lamp
