#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lamp/core/Geometry.h"

namespace lamp::evaluation {

/** The error of a relative pose, and how certain it claims to be. */
struct ClaimedPose {
  Pose3 error = Pose3::Identity();          ///< from_T_to⁻¹ (true) · from_T_to (estimated)
  Matrix6d information = Matrix6d::Zero();  ///< tangent space at from_T_to
};

/** How well claimed covariances fit the errors: if they are right, 5 % of the errors lie beyond
 * their 95 %, and each axis' normalised variance is 1. */
struct CovarianceScore {
  size_t count = 0;
  /** Share of the errors whose squared Mahalanobis distance exceeds the 95 % quantile of chi-square
   * with as many degrees of freedom as the pose claims to know. */
  double beyond_95 = 0;
  /** Mean of (error / σ)² along x, y, z and about x, y, z, over the poses that claim to know that
   * axis; none if no pose does. */
  std::array<std::optional<double>, 6> normalized_variance;
};

/** Directions with a standard deviation beyond 10 m, or rad, count as unknown; those below 1e-5
 * are not estimated but given, as the height of a planar robot. */
CovarianceScore scoreCovariances(const std::vector<ClaimedPose>& poses);

}  // namespace lamp::evaluation
