#pragma once

#include <string>
#include <vector>

#include "RegisteredCloud.h"
#include "lamp/registration/LoopClosureComputation.h"
#include "lamp/slam_app/SlamConfig.h"

namespace lamp {

/** One registration without a guess. */
struct PairRegistration {
  RegisteredCloud source, target;
  bool planar = false;  ///< both are level: only x, y and yaw are estimated
  LoopClosureAttempt attempt;
  double prepare_source_s = 0, prepare_target_s = 0;  ///< normals, free space, descriptors
  double align_refine_verify_s = 0;

  /** Whether any pose came out, accepted or not. */
  bool hasResult() const;
  /** `accepted`, or who refused and why. */
  std::string verdict() const;
};

/** Registers the clouds of two files with the stages of the configuration, each thinned as the
 * front end thins scans. Stages that start from a guess get the identity, without a covariance.
 * \throws std::runtime_error naming the file that cannot be used. */
PairRegistration registerPair(const std::string& source, const std::string& target,
                              const SlamConfig& config);

}  // namespace lamp
