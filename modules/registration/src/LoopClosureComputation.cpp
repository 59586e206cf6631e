#include "lamp/registration/LoopClosureComputation.h"

#include "lamp/registration/Teaser.h"

namespace lamp {

LoopClosureComputation::LoopClosureComputation(
    std::shared_ptr<const InitialAligner> aligner, std::shared_ptr<const Refiner> refiner,
    std::vector<std::shared_ptr<const Verifier>> verifiers)
    : aligner_(std::move(aligner)),
      refiner_(std::move(refiner)),
      verifiers_(std::move(verifiers)) {}

LoopClosureAttempt LoopClosureComputation::compute(const PreparedScan& source,
                                                   const PreparedScan& target,
                                                   const Guess& guess) const {
  const AlignmentResult alignment = aligner_->align(source, target, guess);
  LoopClosureAttempt attempt;
  attempt.stage = aligner_->getLoggerName();
  attempt.reason = alignment.refusal;
  for (const Hypothesis& hypothesis : alignment.hypotheses) {
    attempt = refineAndVerify(source, target, guess, hypothesis);
    if (attempt.accepted) break;
  }
  return attempt;
}

LoopClosureAttempt LoopClosureComputation::refineAndVerify(const PreparedScan& source,
                                                           const PreparedScan& target,
                                                           const Guess& guess,
                                                           const Hypothesis& hypothesis) const {
  LoopClosureAttempt attempt;
  attempt.result = refiner_->refine(source, target, hypothesis);
  if (!attempt.result.converged) {
    attempt.stage = refiner_->getLoggerName();
    attempt.reason = "did not converge";
    return attempt;
  }
  for (const auto& verifier : verifiers_) {
    const Verification verification = verifier->verify(attempt.result, source, target, guess);
    attempt.scores.insert(attempt.scores.end(), verification.scores.begin(),
                          verification.scores.end());
    if (verification.accepted()) continue;
    attempt.stage = verifier->getLoggerName();
    attempt.reason = verification.refusal;
    return attempt;
  }
  attempt.accepted = true;
  attempt.stage = "verified";
  return attempt;
}

void registerAllClasses_lamp_registration() {
  mrpt::rtti::registerClass(CLASS_ID(InitialAligner));
  mrpt::rtti::registerClass(CLASS_ID(Identity));
  mrpt::rtti::registerClass(CLASS_ID(Odometry));
  mrpt::rtti::registerClass(CLASS_ID(OdometryRotation));
  mrpt::rtti::registerClass(CLASS_ID(Teaser));
  mrpt::rtti::registerClass(CLASS_ID(Refiner));
  mrpt::rtti::registerClass(CLASS_ID(Gicp));
  mrpt::rtti::registerClass(CLASS_ID(PointToPlane));
  mrpt::rtti::registerClass(CLASS_ID(Verifier));
  mrpt::rtti::registerClass(CLASS_ID(OverlapResidual));
  mrpt::rtti::registerClass(CLASS_ID(GuessDeviation));
}

}  // namespace lamp
