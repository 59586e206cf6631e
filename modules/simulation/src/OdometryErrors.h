#pragma once

#include <vector>

#include "lamp/simulation/OdometryModel.h"
#include "lamp/simulation/Random.h"

namespace lamp::simulation {

/** True motion between two samples. */
struct OdometryStep {
  Pose3 motion = Pose3::Identity();  ///< previous_T_this
  double seconds = 0;

  double way_m() const { return motion.translation().norm(); }
  double turned_rad() const { return rotationAngle(motion); }
};

/** Errors of the steps in the tangent space at their motion, without gravity's pull. */
std::vector<Vector6d> drawStepErrors(const std::vector<OdometryStep>& steps,
                                     const OdometryOptions& options, Random& random);

/** What a step adds to the covariance at factor 1: white noise in place of the real errors. */
Matrix6d claimedStepCovariance(const OdometryStep& step, const OdometryOptions& options);

}  // namespace lamp::simulation
