#pragma once

#include <cstdint>
#include <optional>

#include "lamp/scans/GlobalAlignment.h"
#include "lamp/scans/PreparedScan.h"

namespace lamp {

struct SampleConsensusOptions {
  int iterations = 500;
  int similar_keypoints = 5;
  double min_sample_distance_m = 1.0;
  double correspondence_m = 1.0;
  uint32_t seed = 1;  ///< of the samples; no option: stages have it from the run

  void visit(OptionVisitor& v);
};

/** Tries poses of three random keypoints of the source, spread out, each with a random one of the
 * target's keypoints that look most like it; keeps the pose that brings the source's keypoints
 * nearest to the target, distances counted up to `correspondence_m` (SAC-IA, Rusu et al. 2009).
 * \return none with fewer than three keypoints on a side. `inliers` are keypoints with a target
 * point within `correspondence_m`. The same seed gives the same pose. */
std::optional<GlobalPose> alignBySamples(const Features& source, const PreparedScan& target,
                                         const SampleConsensusOptions& options);

}  // namespace lamp
