#include "PairRegistration.h"

#include <algorithm>
#include <chrono>
#include <tuple>
#include <utility>

#include "MapRegistration.h"
#include "lamp/scans/Cloud.h"

namespace lamp {

namespace {

/** A level laser's points differ in height by no more than rounding. */
constexpr float kLevel_m = 1e-3f;

class Stopwatch {
 public:
  /** Since the last call, or since it was made. */
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

void registerViews(PairRegistration& pair, const PreparedScan& source, const SlamConfig& config) {
  const Eigen::Vector3f viewpoint = pair.source.scan->sensors.front().position.cast<float>();
  MapRegistration registration = registerOnMap(source, viewpoint, pair.target.map, config);
  pair.attempt = std::move(registration.attempt);
  pair.target.notes.push_back("it was not seen from one place: of " +
                              std::to_string(registration.views) + " views from places in it " +
                              std::to_string(registration.agreeing) + " agree on the best pose");
}

/** A map has no free space and no sides of walls. */
void noteMaps(PairRegistration& pair) {
  if (!pair.source.map.empty())
    pair.source.notes.push_back(
        "it was not seen from one place, as a scan is: give a map as the target, or cut out what "
        "can be seen from one place in it, with that place as VIEWPOINT");
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
  noteMaps(pair);
  const bool onto_map = !pair.target.map.empty() && pair.source.map.empty() && !pair.planar;
  if (onto_map)
    registerViews(pair, *prepared_source, config);
  else
    pair.attempt =
        config.makeLoopClosureComputation().compute(*prepared_source, *prepared_target, Guess());
  pair.align_refine_verify_s = watch.seconds();
  return pair;
}

}  // namespace lamp
