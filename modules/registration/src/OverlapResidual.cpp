#include "lamp/registration/OverlapResidual.h"

IMPLEMENTS_MRPT_OBJECT(OverlapResidual, lamp::Verifier, lamp)

namespace lamp {

void OverlapResidualOptions::visit(OptionVisitor& v) {
  v("min_overlap", min_overlap, "",
    "minimum fraction of the source's own points that have a correspondence among the target's own",
    kShare);
  v("max_residual_m", max_residual_m, "m",
    "maximum r.m.s. point-to-plane distance, beyond the noise of both scans", kPositive);
  v("partner_distance_m", partner_distance_m, "m", "maximum distance to a correspondence",
    kPositive);
}

Verification OverlapResidual::verify(const RegistrationResult& result, const PreparedScan& source,
                                     const PreparedScan& target, const Guess&) const {
  const Agreement found =
      agreement(source, target, result.target_T_source, options.partner_distance_m);
  // Points off their own surface by noise are as far off the other scan's.
  const double max_residual_m = Eigen::Vector3d(coarseness(source, target) * options.max_residual_m,
                                                source.noise(), target.noise())
                                    .norm();
  Verification verification;
  verification.scores = {{"overlap", found.overlap, options.min_overlap},
                         {"residual_m", found.residual_m, max_residual_m}};
  if (found.overlap < options.min_overlap)
    verification.refusal = "low overlap";
  else if (found.residual_m > max_residual_m)
    verification.refusal = "high residual";
  return verification;
}

}  // namespace lamp
