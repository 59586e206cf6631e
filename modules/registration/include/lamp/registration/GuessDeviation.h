#pragma once

#include "lamp/registration/Verifier.h"

namespace lamp {

struct GuessDeviationOptions {
  double probability = 0.99;
  double slack_m = 0.5;
  double slack_deg = 5.0;

  void visit(OptionVisitor& v);
};

/** The result must not lie farther from the guess than the guess's own uncertainty allows: the
 * squared Mahalanobis distance stays below the χ² quantile, and so does that of the position alone:
 * places that look alike mostly lie the same way round, and three right angles would excuse a
 * position that is far off (the storeys of a building). A slack keeps an overconfident graph
 * from refusing everything. */
class GuessDeviation : public Verifier {
  DEFINE_MRPT_OBJECT(GuessDeviation, lamp)

 public:
  GuessDeviationOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  Verification verify(const RegistrationResult& result, const PreparedScan& source,
                      const PreparedScan& target, const Guess& guess) const override;
};

}  // namespace lamp
