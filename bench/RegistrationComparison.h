#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "RecordedPairs.h"
#include "lamp/registration/LoopClosureComputation.h"
#include "lamp/slam_app/SlamConfig.h"

namespace lamp {

/** Our stages with their default options, started by Teaser. */
struct OurRegistration {
  explicit OurRegistration(const SlamConfig& config);

  PreparedScanPtr prepare(const Cloud& cloud) const;

  const ScanPreparationOptions options;
  const std::shared_ptr<const InitialAligner> aligner;
  const std::shared_ptr<const Refiner> refiner;
  const LoopClosureComputation verified, unverified;
};

/** What came of one pair. Times in milliseconds. */
struct Outcome {
  bool accepted = false, right = false, gicp_right = false;
  double candidate = 0, gicp = 0, preparation = 0;
};

struct OurOutcome : Outcome {
  bool observes_all = true;       ///< all directions of the relative pose
  bool right_unverified = false;  ///< the best hypothesis, whatever verifiers say
  std::string refusal;
};

struct Comparison {
  double overlap = 0;
  OurOutcome ours;
  std::optional<Outcome> peer;
};

double millisecondsOf(const std::function<void()>& work);

/** Registers a pair without any guess, and refines it from a start near the truth. */
Comparison compareOn(const RecordedPair& pair, const OurRegistration& ours, bool with_peer);

}  // namespace lamp
