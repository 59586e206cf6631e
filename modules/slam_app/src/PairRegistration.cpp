#include "PairRegistration.h"

#include <algorithm>
#include <chrono>
#include <tuple>
#include <utility>

#include "lamp/scans/Cloud.h"

namespace lamp {

namespace {

/** A level laser's points differ in height by no more than rounding. */
constexpr float kLevel_m = 1e-3f;

class Stopwatch {
 public:
  /** Since it was made, or read before. */
  double seconds() {
    const auto now = Clock::now(), before = std::exchange(start_, now);
    return std::chrono::duration<double>(now - before).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

bool isLevel(const Scan& scan) {
  const auto [low, high] =
      std::minmax_element(scan.points.begin(), scan.points.end(),
                          [](const auto& a, const auto& b) { return a.z() < b.z(); });
  return high->z() - low->z() < kLevel_m;
}

PreparedScanPtr prepare(const RegisteredCloud& cloud, const PreparationOptions& options,
                        bool planar) {
  auto scan = std::make_shared<PreparedScan>(
      accumulate({{cloud.scan, Pose3::Identity()}}, options.accumulate_voxel_m), options.scan,
      planar);
  scan->features();  // now, so that they do not count as alignment
  return scan;
}

}  // namespace

bool PairRegistration::hasResult() const {
  return std::any_of(
      attempt.alignments.begin(), attempt.alignments.end(),
      [](const AlignerOutcome& outcome) { return !outcome.alignment.hypotheses.empty(); });
}

std::string PairRegistration::verdict() const {
  if (attempt.accepted) return "accepted";
  return "refused by " + attempt.stage + ": " + attempt.reason;
}

PairRegistration registerPair(const std::string& source, const std::string& target,
                              const SlamConfig& config) {
  PairRegistration pair;
  std::tie(pair.source, pair.target) = loadClouds(source, target, config.frontend);
  pair.planar = isLevel(*pair.source.scan) && isLevel(*pair.target.scan);
  Stopwatch watch;
  const auto prepared_source = prepare(pair.source, config.registration.preparation, pair.planar);
  pair.prepare_source_s = watch.seconds();
  const auto prepared_target = prepare(pair.target, config.registration.preparation, pair.planar);
  pair.prepare_target_s = watch.seconds();
  pair.attempt =
      config.makeLoopClosureComputation().compute(*prepared_source, *prepared_target, Guess());
  pair.align_refine_verify_s = watch.seconds();
  return pair;
}

}  // namespace lamp
