#pragma once

#include "lamp/registration/Verifier.h"

namespace lamp {

struct BothDirectionsOptions {
  double max_distance_m = 0.3;
  double max_angle_deg = 3.0;
  IcpOptions icp;

  void visit(OptionVisitor& v);
};

/** The target's own scan, refined against the source and its neighbours from the result's inverse,
 * must stay there, in the directions that the result claims to know. */
class BothDirections : public Verifier {
  DEFINE_MRPT_OBJECT(BothDirections, lamp)

 public:
  BothDirections();
  BothDirectionsOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  Verification verify(const RegistrationResult& result, const PreparedScan& source,
                      const PreparedScan& target, const Guess& guess) const override;
};

}  // namespace lamp
