#include "lamp/registration/LoopClosureComputation.h"

#include <algorithm>
#include <cmath>

#include "lamp/registration/ObservedPart.h"
#include "lamp/scans/Agreement.h"

namespace lamp {

void AmbiguityOptions::visit(OptionVisitor& v) {
  v("ambiguity_distance_m", ambiguity_distance_m, "m",
    "two accepted hypotheses farther apart than this count as different answers", kPositive);
  v("ambiguity_angle_deg", ambiguity_angle_deg, "deg",
    "two accepted hypotheses farther apart than this count as different answers", kPositive);
  v("ambiguity_overlap", ambiguity_overlap, "",
    "of two different answers the one with more overlap is taken, unless the other reaches this "
    "fraction of it: then the pair is refused as ambiguous",
    kShare);
  look_alikes.visit(v);
}

LoopClosureComputation::LoopClosureComputation(
    std::vector<std::shared_ptr<const InitialAligner>> aligners,
    std::shared_ptr<const Refiner> refiner, std::vector<std::shared_ptr<const Verifier>> verifiers,
    const AmbiguityOptions& ambiguity)
    : aligners_(std::move(aligners)),
      refiner_(std::move(refiner)),
      verifiers_(std::move(verifiers)),
      ambiguity_(ambiguity) {}

LoopClosureAttempt LoopClosureComputation::compute(const PreparedScan& source,
                                                   const PreparedScan& target, const Guess& guess,
                                                   bool certain_guess) const {
  Followed best;
  std::vector<AlignerOutcome> alignments;
  for (const auto& aligner : aligners_) {
    if (certain_guess && !alignments.empty()) break;
    alignments.push_back({aligner->getLoggerName(), aligner->align(source, target, guess)});
    Followed followed = follow(alignments.back(), source, target, guess);
    if (alignments.size() == 1 || followed.steps > best.steps) best = std::move(followed);
    if (best.attempt.accepted) break;
  }
  if (best.attempt.accepted) refuseIfAlike(best.attempt, source, target, guess);
  best.attempt.alignments = std::move(alignments);
  return std::move(best.attempt);
}

LoopClosureComputation::Followed LoopClosureComputation::follow(const AlignerOutcome& outcome,
                                                                const PreparedScan& source,
                                                                const PreparedScan& target,
                                                                const Guess& guess) const {
  Followed best;
  best.attempt.stage = outcome.aligner;
  best.attempt.reason = outcome.alignment.refusal;
  for (const Hypothesis& hypothesis : outcome.alignment.hypotheses) {
    Followed followed = refineAndVerify(source, target, guess, hypothesis);
    if (best.attempt.accepted && followed.attempt.accepted &&
        differ(best.attempt.result, followed.attempt.result)) {
      if (settle(best, followed, source, target)) continue;
      best.attempt.accepted = false;
      best.attempt.stage = outcome.aligner;
      best.attempt.reason = "ambiguous";
      return best;
    }
    if (followed.steps > best.steps) best = std::move(followed);
  }
  return best;
}

LoopClosureComputation::Followed LoopClosureComputation::refineAndVerify(
    const PreparedScan& source, const PreparedScan& target, const Guess& guess,
    const Hypothesis& hypothesis) const {
  Followed followed;
  LoopClosureAttempt& attempt = followed.attempt;
  if (hypothesis.inliers > 0)
    attempt.scores = {{"inliers", static_cast<double>(hypothesis.inliers), std::nullopt},
                      {"inlier_ratio", hypothesis.inlier_ratio, std::nullopt}};
  attempt.result = refiner_->refine(source, target, hypothesis);
  attempt.scores.insert(attempt.scores.end(), attempt.result.scores.begin(),
                        attempt.result.scores.end());
  followed.steps = 1;
  attempt.stage = refiner_->getLoggerName();
  if (!attempt.result.converged)
    attempt.reason = "did not converge";
  else if (attempt.result.information.isZero())
    attempt.reason = "no common surface that constrains the pose";
  if (!attempt.reason.empty()) return followed;
  for (const auto& verifier : verifiers_) {
    ++followed.steps;
    const Verification verification = verifier->verify(attempt.result, source, target, guess);
    attempt.scores.insert(attempt.scores.end(), verification.scores.begin(),
                          verification.scores.end());
    if (verification.accepted()) continue;
    attempt.stage = verifier->getLoggerName();
    attempt.reason = verification.refusal;
    return followed;
  }
  ++followed.steps;
  attempt.accepted = true;
  attempt.stage = "verified";
  return followed;
}

bool LoopClosureComputation::settle(Followed& best, Followed& other, const PreparedScan& source,
                                    const PreparedScan& target) const {
  const auto overlap = [&](const Followed& followed) {
    return agreement(source, target, followed.attempt.result.target_T_source, kPartnerDistance_m)
        .overlap;
  };
  const double of_best = overlap(best), of_other = overlap(other);
  if (of_other > of_best) std::swap(best, other);
  return std::min(of_best, of_other) < ambiguity_.ambiguity_overlap * std::max(of_best, of_other);
}

void LoopClosureComputation::refuseIfAlike(LoopClosureAttempt& found, const PreparedScan& source,
                                           const PreparedScan& target, const Guess& guess) const {
  const std::vector<Pose3> starts =
      lookAlikeStarts(found.result, guess, source, target, ambiguity_.look_alikes);
  if (starts.empty()) return;
  const Fit fit = fitOf(source, target, found.result.target_T_source);
  std::vector<RegistrationResult> seen{found.result};
  for (const Pose3& start : starts) {
    Hypothesis hypothesis;
    hypothesis.target_T_source = start;
    const RegistrationResult other = refiner_->refine(source, target, hypothesis);
    const auto isNew = [&](const RegistrationResult& before) { return differ(before, other); };
    if (!other.converged || !std::all_of(seen.begin(), seen.end(), isNew)) continue;
    seen.push_back(other);
    if (!isAsGood(fitOf(source, target, other.target_T_source), fit)) continue;
    found.accepted = false;
    found.stage = "look_alikes";
    found.reason = "ambiguous";
    return;
  }
}

bool LoopClosureComputation::differ(const RegistrationResult& a,
                                    const RegistrationResult& b) const {
  const Vector6d apart =
      observedPart(logSE3(a.target_T_source.inverse() * b.target_T_source), a.information);
  return apart.head<3>().norm() > ambiguity_.ambiguity_distance_m ||
         apart.tail<3>().norm() * 180.0 / M_PI > ambiguity_.ambiguity_angle_deg;
}

}  // namespace lamp
