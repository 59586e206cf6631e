#pragma once

#include "lamp/registration/Verifier.h"

namespace lamp {

struct PclFitnessOptions {
  double max_alignment_m2 = 32;
  double max_refined_m2 = 0.9;

  void visit(OptionVisitor& v);
};

/** The gates of LAMP 1.0 and 2.0: the mean squared distance of all source points from their nearest
 * target points, which PCL calls fitness, after the initial alignment and after the refinement
 * (paper III-B). For comparison: it measures the size of the scans more than the quality of the
 * registration. */
class PclFitness : public Verifier {
  DEFINE_MRPT_OBJECT(PclFitness, lamp)

 public:
  PclFitnessOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  Verification verify(const RegistrationResult& result, const PreparedScan& source,
                      const PreparedScan& target, const Guess& guess) const override;
};

}  // namespace lamp
