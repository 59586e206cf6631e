#pragma once

#include "lamp/registration/Verifier.h"

namespace lamp {

struct FreeSpaceConsistencyOptions {
  double max_share = 0.2;
  double margin_m = 0.3;

  void visit(OptionVisitor& v);
};

/** Few points of one scan may lie where the other's rays passed: a look-alike place that has more,
 * or less, in it than the right one gives itself away. Both scans are asked. */
class FreeSpaceConsistency : public Verifier {
  DEFINE_MRPT_OBJECT(FreeSpaceConsistency, lamp)

 public:
  FreeSpaceConsistencyOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  Verification verify(const RegistrationResult& result, const PreparedScan& source,
                      const PreparedScan& target, const Guess& guess) const override;
};

}  // namespace lamp
