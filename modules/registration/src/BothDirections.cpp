#include "lamp/registration/BothDirections.h"

#include <cmath>

#include "lamp/registration/ObservedPart.h"

IMPLEMENTS_MRPT_OBJECT(BothDirections, lamp::Verifier, lamp)

namespace lamp {

BothDirections::BothDirections() {
  // It starts where it should end.
  options.icp.start_correspondence_m = options.icp.correspondence_m;
}

void BothDirectionsOptions::visit(OptionVisitor& v) {
  v("max_distance_m", max_distance_m, "m", "maximum difference between the two results", kPositive);
  v("max_angle_deg", max_angle_deg, "deg", "maximum difference between the two results", kPositive);
  icp.visit(v);
}

Verification BothDirections::verify(const RegistrationResult& result, const PreparedScan& source,
                                    const PreparedScan& target, const Guess&) const {
  if (!isFinite(result.target_T_source)) return {"not a pose", {}};
  const IcpResult back =
      icp(target, source, result.target_T_source.inverse(), IcpMetric::kPlaneToPlane, options.icp);
  const Vector6d deviation =
      observedPart(logSE3(result.target_T_source.inverse() * back.target_T_source.inverse()),
                   result.information);
  const double distance = deviation.head<3>().norm();
  const double angle = deviation.tail<3>().norm() * 180.0 / M_PI;
  Verification verification;
  verification.scores = {{"back_dist_m", distance, options.max_distance_m},
                         {"back_angle_deg", angle, options.max_angle_deg}};
  if (!back.converged || distance > options.max_distance_m || angle > options.max_angle_deg)
    verification.refusal = "directions disagree";
  return verification;
}

}  // namespace lamp
