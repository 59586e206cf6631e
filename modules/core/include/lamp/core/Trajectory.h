#pragma once

#include <string>
#include <vector>

#include "lamp/core/KeyNodePacket.h"

namespace lamp {

/** TUM format: `stamp x y z qx qy qz qw`, stamps with 6 decimals. */
std::string toTum(const std::vector<StampedPose>& trajectory);
/** Reads a TUM file; `#` starts a comment. Columns may be separated by spaces, tabs, commas or
 * semicolons; stamps may be seconds, or milli-, micro- or nanoseconds since 1970. Sorted by stamp;
 * of equal stamps the first is kept.
 *  \throws std::runtime_error with file and line if a row is malformed, stamps have lost their
 *  digits, or the file has no row. */
std::vector<StampedPose> readTum(const std::string& path);

/** Pose at a stamp by constant-twist interpolation. */
class TrajectoryInterpolator {
 public:
  /** \param trajectory sorted by stamp, stamps distinct, not empty. */
  explicit TrajectoryInterpolator(std::vector<StampedPose> trajectory);
  double begin() const { return trajectory_.front().stamp; }
  double end() const { return trajectory_.back().stamp; }
  /** Clamped to the ends. */
  Pose3 at(double stamp) const;

 private:
  std::vector<StampedPose> trajectory_;
};

}  // namespace lamp
