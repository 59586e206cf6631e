#pragma once

#include <string>
#include <vector>

#include "lamp/evaluation/LoopScore.h"
#include "lamp/evaluation/RunFiles.h"
#include "lamp/evaluation/Truth.h"

namespace lamp::evaluation {

struct LoopEvaluation {
  std::vector<JudgedLoop> loops;  ///< one a pair of key nodes
  LoopScore all, within_robots, between_robots;
  std::vector<std::string> warnings;
};

/** Judges the run's ledger by the true trajectories and the keyed scans. Does not depend on how
 * the run is aligned. \throws std::runtime_error if a file is missing or malformed. */
LoopEvaluation evaluateLoops(const RunFiles& run, const TruthFolder& truth);

}  // namespace lamp::evaluation
