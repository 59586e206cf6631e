#include "RegistrationComparison.h"

#include <chrono>
#include <cmath>

#include "PclPeer.h"
#include "lamp/registration/ObservedPart.h"

namespace lamp {

namespace {

std::vector<std::shared_ptr<const Verifier>> verifiersOf(const SlamConfig& config) {
  const auto verifiers = config.make<Verifier>();
  return {verifiers.begin(), verifiers.end()};
}

std::shared_ptr<InitialAligner> teaserOf(const SlamConfig& config) {
  Faults faults;
  auto teaser = makeStage<InitialAligner>(StageName::parse("Teaser"), "initial aligner", "",
                                          config.ini(), faults);
  faults.throwIfAny();
  return teaser;
}

/** Tells right poses by the truth, in the directions that the scans observe there. */
class Judge {
 public:
  Judge(const OurRegistration& ours, const PreparedScan& source, const PreparedScan& target,
        const Pose3& truth)
      : truth_(truth), at_truth_(ours.refiner->refine(source, target, startingAt(truth))) {}

  bool isRight(const Pose3& target_T_source) const {
    constexpr double kRight_m = 0.2, kRight = 2 * M_PI / 180;
    const Vector6d error =
        observedPart(logSE3(target_T_source.inverse() * truth_), at_truth_.information);
    return error.head<3>().norm() <= kRight_m && error.tail<3>().norm() <= kRight;
  }
  bool observesAll() const { return at_truth_.unobserved.empty(); }

  static Hypothesis startingAt(const Pose3& pose) {
    Hypothesis start;
    start.target_T_source = pose;
    return start;
  }

 private:
  Pose3 truth_;
  RegistrationResult at_truth_;
};

/** A start as a good global alignment gives it. */
Pose3 nearTruth(const Pose3& truth) {
  constexpr double kOffset = 0.3 / 1.7320508, kAngle = 3 * M_PI / 180 / 1.7320508;
  Vector6d off;
  off << kOffset, -kOffset, kOffset, kAngle, -kAngle, kAngle;
  return truth * expSE3(off);
}

OurOutcome measureOurs(const OurRegistration& ours, const PreparedScan& source,
                       const PreparedScan& target, const Pose3& truth, const Judge& judge) {
  OurOutcome outcome;
  LoopClosureAttempt attempt;
  outcome.candidate = millisecondsOf([&] { attempt = ours.verified.compute(source, target, {}); });
  outcome.accepted = attempt.accepted;
  outcome.right = judge.isRight(attempt.result.target_T_source);
  if (!attempt.accepted) outcome.refusal = attempt.stage + ": " + attempt.reason;
  attempt = ours.unverified.compute(source, target, {});
  outcome.right_unverified = attempt.accepted && judge.isRight(attempt.result.target_T_source);
  RegistrationResult refined;
  const Hypothesis start = Judge::startingAt(nearTruth(truth));
  outcome.gicp = millisecondsOf([&] { refined = ours.refiner->refine(source, target, start); });
  outcome.gicp_right = judge.isRight(refined.target_T_source);
  outcome.observes_all = judge.observesAll();
  return outcome;
}

Outcome measurePeer(const RecordedPair& pair, const Judge& judge) {
  Outcome outcome;
  std::optional<PclScan> source;
  outcome.preparation = millisecondsOf([&] { source.emplace(pair.source); });
  const PclScan target(pair.target);
  PclResult result;
  outcome.candidate = millisecondsOf([&] { result = pclSacIaAndGicp(*source, target); });
  outcome.accepted = result.accepted();
  outcome.right = judge.isRight(result.target_T_source);
  const Pose3 start = nearTruth(pair.target_T_source);
  outcome.gicp = millisecondsOf([&] { result = pclGicp(*source, target, start); });
  outcome.gicp_right = judge.isRight(result.target_T_source);
  return outcome;
}

}  // namespace

OurRegistration::OurRegistration(const SlamConfig& config)
    : options(config.registration.preparation.scan),
      aligner(teaserOf(config)),
      refiner(config.makeOne<Refiner>()),
      verified({aligner}, refiner, verifiersOf(config), config.registration.ambiguity),
      unverified({aligner}, refiner, {}, config.registration.ambiguity) {}

PreparedScanPtr OurRegistration::prepare(const Cloud& cloud) const {
  auto prepared = std::make_shared<PreparedScan>(cloud, options, false);
  prepared->features();
  return prepared;
}

double millisecondsOf(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

Comparison compareOn(const RecordedPair& pair, const OurRegistration& ours, bool with_peer) {
  PreparedScanPtr source;
  const double preparation = millisecondsOf([&] { source = ours.prepare(pair.source); });
  const PreparedScanPtr target = ours.prepare(pair.target);
  const Judge judge(ours, *source, *target, pair.target_T_source);
  Comparison comparison;
  comparison.overlap = pair.overlap;
  comparison.ours = measureOurs(ours, *source, *target, pair.target_T_source, judge);
  comparison.ours.preparation = preparation;
  if (with_peer) comparison.peer = measurePeer(pair, judge);
  return comparison;
}

}  // namespace lamp
