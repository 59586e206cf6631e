#pragma once

#include <string>
#include <vector>

#include "lamp/core/Options.h"
#include "lamp/scans/MatchedSurface.h"
#include "lamp/scans/Observability.h"

namespace lamp {

struct RegistrationInformationOptions {
  double sigma_m = 0.015;
  double min_translation_observability = 0.01;
  double min_rotation_observability = 0.002;
  double common_share = 0.65;

  void visit(OptionVisitor& v);
};

/** What a registration knows of a relative pose. */
struct RegistrationInformation {
  /** Inverse covariance in the tangent space at the pose, without the unobserved directions. */
  Matrix6d information = Matrix6d::Zero();
  Observability observability;
  std::vector<std::string> unobserved;  ///< directions in words
};

/** From the information matrix A of point-to-plane ICP: covariance `σ² A⁻¹`, σ² the residual's
 * variance plus the model's, A counted by independent patches of surface instead of points (what is
 * wrong with one point is wrong with its neighbours); and of σ² a share that all patches have in
 * common, in every direction, rotations as lengths at the points' r.m.s. distance.
 *
 * Directions of which the scans say next to nothing (the axis of a tunnel) get no information
 * instead of little: noise looks like some (paper II-C; Zhang, Kaess, Singh, ICRA 2016). */
RegistrationInformation registrationInformation(const MatchedSurface& surface,
                                                const Pose3& target_T_source,
                                                const RegistrationInformationOptions& options,
                                                bool planar);

}  // namespace lamp
