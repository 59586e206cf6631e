#pragma once

#include "lamp/registration/InitialAligner.h"

namespace lamp {

struct PlanarSearchOptions {
  double search_radius_m = 10.0;
  int max_hypotheses = 3;

  void visit(OptionVisitor& v);
};

/** Aligns scans of level 2D lasers of which the graph knows nothing: all headings, and all shifts up
 * to a radius (alignInPlane()). Where it has a guess, with a covariance, this finds nothing: what
 * looks alike in a corridor would be found sooner than what is right. */
class PlanarSearch : public InitialAligner {
  DEFINE_MRPT_OBJECT(PlanarSearch, lamp)

 public:
  PlanarSearchOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  AlignmentResult align(const PreparedScan& source, const PreparedScan& target,
                        const Guess& guess) const override;
};

}  // namespace lamp
