#pragma once

#include "lamp/core/Options.h"

namespace lamp {

/** Section `[refinement]`. */
struct RefinementOptions {
  int max_rounds = 4;
  double cell_m = 1.0;
  double min_shared = 0.2;
  double max_distance_m = 25.0;
  int pairs_per_node = 16;

  void visit(OptionVisitor& v);
};

}  // namespace lamp
