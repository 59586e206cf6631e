#pragma once

#include "lamp/registration/InitialAligner.h"
#include "lamp/scans/GlobalAlignment.h"

namespace lamp {

/** Aligns without a usable guess, by the recipe of TEASER (Yang, Shi, Carlone, T-RO 2021; paper
 * II-C): matches of descriptors that are consistent in pairs. If the guess's covariance is known,
 * matches that it rules out are not looked at. */
class Teaser : public InitialAligner {
  DEFINE_MRPT_OBJECT(Teaser, lamp)

 public:
  ConsistencyOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  AlignmentResult align(const PreparedScan& source, const PreparedScan& target,
                        const Guess& guess) const override;
};

}  // namespace lamp
