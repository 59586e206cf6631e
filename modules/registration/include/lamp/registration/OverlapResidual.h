#pragma once

#include "lamp/registration/Verifier.h"
#include "lamp/scans/Agreement.h"

namespace lamp {

struct OverlapResidualOptions {
  double min_overlap = 0.35;
  double max_residual_m = 0.12;
  double partner_distance_m = kPartnerDistance_m;

  void visit(OptionVisitor& v);
};

/** Both scans themselves must have seen enough in common, and the source must lie close to the
 * target. */
class OverlapResidual : public Verifier {
  DEFINE_MRPT_OBJECT(OverlapResidual, lamp)

 public:
  OverlapResidualOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  Verification verify(const RegistrationResult& result, const PreparedScan& source,
                      const PreparedScan& target, const Guess& guess) const override;
};

}  // namespace lamp
