#pragma once

#include "lamp/core/Seeded.h"
#include "lamp/registration/InitialAligner.h"
#include "lamp/scans/SampleConsensus.h"

namespace lamp {

/** Sample consensus initial alignment (Rusu, Blodow, Beetz, ICRA 2009; paper II-C). Kept for
 * comparison: Teaser finds more, in less time. */
class SacIa : public InitialAligner, public Seeded {
  DEFINE_MRPT_OBJECT(SacIa, lamp)

 public:
  SampleConsensusOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  void setSeed(uint32_t seed) override { options.seed = seed; }
  AlignmentResult align(const PreparedScan& source, const PreparedScan& target,
                        const Guess& guess) const override;
};

}  // namespace lamp
