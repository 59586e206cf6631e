#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lamp/registration/InitialAligner.h"
#include "lamp/registration/LookAlikes.h"
#include "lamp/registration/Refiner.h"
#include "lamp/registration/Verifier.h"

namespace lamp {

/** When two accepted hypotheses of one pair are different answers, and as good. */
struct AmbiguityOptions {
  double ambiguity_distance_m = 1.0;
  double ambiguity_angle_deg = 10.0;
  double ambiguity_overlap = 0.8;
  LookAlikeOptions look_alikes;

  void visit(OptionVisitor& v);
};

/** What an aligner found. */
struct AlignerOutcome {
  std::string aligner;
  AlignmentResult alignment;
};

/** Outcome of one attempt to close a loop. */
struct LoopClosureAttempt {
  bool accepted = false;
  std::string stage;   ///< the stage that refused, or `verified`
  std::string reason;  ///< why it was refused; empty if it was not
  RegistrationResult result;
  std::vector<Score> scores;
  std::vector<AlignerOutcome> alignments;  ///< of the aligners that were asked
};

/** Align, refine, verify (paper II-C, "Loop closure computation").
 *
 * The aligners are asked in turn until one's hypotheses lead to a loop closure. All hypotheses of
 * an aligner are followed to the end: if two that differ are accepted, and explain about as much of
 * the source, the scans look alike in two ways, and there is no telling which is right.
 */
class LoopClosureComputation {
 public:
  LoopClosureComputation(std::vector<std::shared_ptr<const InitialAligner>> aligners,
                         std::shared_ptr<const Refiner> refiner,
                         std::vector<std::shared_ptr<const Verifier>> verifiers,
                         const AmbiguityOptions& ambiguity);

  /** Of several refused hypotheses the outcome is that of the one that came farthest. Safe to call
   * from many threads. \param certain_guess asks the first aligner only. */
  LoopClosureAttempt compute(const PreparedScan& source, const PreparedScan& target,
                             const Guess& guess, bool certain_guess = false) const;
  /** One hypothesis, refined and verified. Safe to call from many threads. */
  LoopClosureAttempt follow(const PreparedScan& source, const PreparedScan& target,
                            const Guess& guess, const Hypothesis& hypothesis) const {
    return refineAndVerify(source, target, guess, hypothesis).attempt;
  }
  RegistrationResult refine(const PreparedScan& source, const PreparedScan& target,
                            const Hypothesis& hypothesis) const {
    return refiner_->refine(source, target, hypothesis);
  }

 private:
  /** An attempt and how many steps it took before it was refused. */
  struct Followed {
    LoopClosureAttempt attempt;
    size_t steps = 0;
  };
  Followed follow(const AlignerOutcome& outcome, const PreparedScan& source,
                  const PreparedScan& target, const Guess& guess) const;
  Followed refineAndVerify(const PreparedScan& source, const PreparedScan& target,
                           const Guess& guess, const Hypothesis& hypothesis) const;
  /** Refuses an accepted attempt if the guess allows another pose that fits as well. */
  void refuseIfAlike(LoopClosureAttempt& found, const PreparedScan& source,
                     const PreparedScan& target, const Guess& guess) const;
  bool differ(const RegistrationResult& a, const RegistrationResult& b) const;
  /** Keeps the better of two accepted attempts that differ. \return whether one is. */
  bool settle(Followed& best, Followed& other, const PreparedScan& source,
              const PreparedScan& target) const;

  std::vector<std::shared_ptr<const InitialAligner>> aligners_;
  std::shared_ptr<const Refiner> refiner_;
  std::vector<std::shared_ptr<const Verifier>> verifiers_;
  AmbiguityOptions ambiguity_;
};

/** Registers all initial aligners, refiners and verifiers of this module. */
void registerAllClasses_lamp_registration();

}  // namespace lamp
