#pragma once

#include "lamp/registration/Verifier.h"

namespace lamp {

struct OverlapResidualOptions {
  double min_overlap = 0.35;
  double max_residual_m = 0.12;
  double partner_distance_m = 0.5;

  void visit(OptionVisitor& v);
};

/** Enough of the source must lie on the target, and close to it. */
class OverlapResidual : public Verifier {
  DEFINE_MRPT_OBJECT(OverlapResidual, lamp)

 public:
  OverlapResidualOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  Verification verify(const RegistrationResult& result, const PreparedScan& source,
                      const PreparedScan& target, const Guess& guess) const override;
};

}  // namespace lamp
