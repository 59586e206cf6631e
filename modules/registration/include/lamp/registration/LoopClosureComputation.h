#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lamp/registration/InitialAligner.h"
#include "lamp/registration/Refiner.h"
#include "lamp/registration/Verifier.h"

namespace lamp {

/** Outcome of one attempt to close a loop. */
struct LoopClosureAttempt {
  bool accepted = false;
  std::string stage;   ///< the stage that refused, or `verified`
  std::string reason;  ///< why it was refused; empty if it was not
  RegistrationResult result;
  std::vector<Score> scores;
};

/** Align, refine, verify (paper II-C, "Loop closure computation"). */
class LoopClosureComputation {
 public:
  LoopClosureComputation(std::shared_ptr<const InitialAligner> aligner,
                         std::shared_ptr<const Refiner> refiner,
                         std::vector<std::shared_ptr<const Verifier>> verifiers);

  /** Safe to call from many threads. */
  LoopClosureAttempt compute(const PreparedScan& source, const PreparedScan& target,
                             const Guess& guess) const;

 private:
  LoopClosureAttempt refineAndVerify(const PreparedScan& source, const PreparedScan& target,
                                     const Guess& guess, const Hypothesis& hypothesis) const;

  std::shared_ptr<const InitialAligner> aligner_;
  std::shared_ptr<const Refiner> refiner_;
  std::vector<std::shared_ptr<const Verifier>> verifiers_;
};

/** Registers Identity, Odometry, OdometryRotation, Gicp, PointToPlane, OverlapResidual and
 * GuessDeviation. */
void registerAllClasses_lamp_registration();

}  // namespace lamp
