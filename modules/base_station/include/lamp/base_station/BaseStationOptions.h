#pragma once

#include "lamp/core/Options.h"

namespace lamp {

/** Section `[base_station]`. Work is counted, never timed, so that a run can be repeated. */
struct BaseStationOptions {
  int closures_per_round = 0;
  int optimize_min_loops = 5;
  double optimize_growth = 0.05;
  double repropose_distance_m = 1.0;
  double retry_distance_m = 0.5;
  int max_attempts = 3;

  void visit(OptionVisitor& v);
};

}  // namespace lamp
