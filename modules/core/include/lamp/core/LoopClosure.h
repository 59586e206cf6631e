#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/core/Ids.h"

namespace lamp {

/** A pair of key nodes that may see the same place. `from` is the older one, the target of the
 * registration; `to` the newer one, its source. */
struct LoopClosureCandidate {
  KeyNodeId from, to;
  std::string generator;       ///< the stage that proposed it
  double priority = 0;         ///< set by the prioritizer; larger is sooner
  bool certain_guess = false;  ///< the graph's guess is good: none is to be searched for
  /** Where a recognised place puts `to` seen from `from`: a start where the graph has none. */
  std::optional<Pose3> recognized = std::nullopt;
  std::string why = {};  ///< why it was proposed, in a few words
};

/** A relative pose to start from, with what the graph knows of its error. */
struct Guess {
  Pose3 target_T_source = Pose3::Identity();
  std::optional<Matrix6d> covariance;
};

/** One named figure of a decision, with its threshold where it has one, for the ledger. */
struct Score {
  std::string name;
  double value = 0;
  std::optional<double> threshold;
};

}  // namespace lamp
