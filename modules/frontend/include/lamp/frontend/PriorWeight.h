#pragma once

#include <deque>

#include "lamp/core/Geometry.h"
#include "lamp/frontend/OdometrySource.h"

namespace lamp {

/** What a scan says against where it was expected. */
struct Innovation {
  Vector6d difference = Vector6d::Zero();  ///< from the prediction to the scan's own pose
  Matrix6d expected = Matrix6d::Zero();    ///< inverse of its covariance; may be singular

  /** Squared, over its degrees of freedom: 1 on average if all is as uncertain as it says. */
  double surprise() const;
};

/** How far another source of odometry is to be believed, from how well it has agreed with the
 * lidar. A source that errs by more than it says gets less weight; one that errs the same way again
 * and again would drag the map along, so that what it says of several scans together counts, too.
 */
class PriorWeight {
 public:
  MotionPrior weighed(const MotionPrior& prior) const {
    return {prior.motion, scale_ * prior.covariance};
  }
  void judge(const Innovation& innovation);

 private:
  double scale_ = 1;  ///< of the source's covariance
  std::deque<double> surprises_;
  Innovation sum_;  ///< over as many scans
};

}  // namespace lamp
