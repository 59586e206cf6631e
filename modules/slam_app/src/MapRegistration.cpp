#include "MapRegistration.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "MapViews.h"
#include "lamp/scans/Agreement.h"
#include "lamp/scans/Cloud.h"
#include "lamp/scans/VoxelFilter.h"

namespace lamp {

namespace {

using Eigen::Vector3f;

/** Close enough together for several views to show what a scan saw. */
constexpr float kSpacing_m = 3;
/** Large maps are looked at from places that lie farther apart. */
constexpr size_t kMaxViews = 500;
/** Among so many views, a scan from elsewhere finds one or two that it agrees with. They do not
 * agree with one another, or with most of what the scan sees. */
constexpr size_t kLeastAgreeing = 3;
constexpr double kLeastOverlap = 0.7;

float quantile(std::vector<float> values, double share) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/** How far nearly all points lie from the sensor, metres. */
float rangeOf(const PreparedScan& scan, const Vector3f& viewpoint) {
  std::vector<float> ranges;
  for (const Vector3f& point : scan.points()) ranges.push_back((point - viewpoint).norm());
  return quantile(std::move(ranges), 0.98);
}

/** Height of the sensor above the floor around it, metres; a usual one where no floor is seen. */
float heightOf(const PreparedScan& scan, const Vector3f& viewpoint) {
  constexpr float kAround_m = 5, kUsual_m = 1, kLowest_m = 0.2f, kHighest_m = 3;
  std::vector<float> depths;
  for (const Vector3f& point : scan.points()) {
    const Vector3f ray = point - viewpoint;
    if (ray.head<2>().norm() < kAround_m && ray.z() < 0) depths.push_back(-ray.z());
  }
  if (depths.empty()) return kUsual_m;
  return std::clamp(quantile(std::move(depths), 0.9), kLowest_m, kHighest_m);
}

std::vector<Vector3f> viewpointsIn(const std::vector<Vector3f>& map, float height_m) {
  float spacing_m = kSpacing_m;
  std::vector<Vector3f> places = standpoints(map, height_m, spacing_m, kMaxViews + 1);
  while (places.size() > kMaxViews)
    places = standpoints(map, height_m, spacing_m *= 2, kMaxViews + 1);
  return places;
}

/** What a lidar would see from places in a map. */
class Views {
 public:
  Views(const std::vector<Vector3f>& map, float range_m, const SlamConfig& config)
      : map_(map), range_m_(range_m), config_(config) {}

  PreparedScanPtr from(const Vector3f& place) const {
    Scan view;
    view.points = visibleFrom(place, map_, range_m_);
    view.sensors = {{"lidar", place.cast<double>()}};
    view.sensor.assign(view.size(), 0);
    AdaptiveVoxelFilter filter(config_.frontend.voxel);
    const auto thinned = std::make_shared<const Scan>(filter.filter(view));
    const PreparationOptions& options = config_.registration.preparation;
    return std::make_shared<const PreparedScan>(
        accumulate({{thinned, Pose3::Identity()}}, options.accumulate_voxel_m), options.scan,
        false);
  }

 private:
  const std::vector<Vector3f>& map_;
  const float range_m_;
  const SlamConfig& config_;
};

/** Robots stand as upright in a map as in their own frame, but for slopes. */
bool isUpright(const Pose3& map_T_scan) {
  constexpr double kCosineOf45Degrees = 0.7071;
  return map_T_scan.linear()(2, 2) > kCosineOf45Degrees;
}

/** The scan against the view from where the pose puts it: only that shows all that it should see.
 */
MapVerification verifyAt(const PreparedScan& scan, const Vector3f& viewpoint,
                         const Pose3& map_T_scan, const Views& views,
                         const LoopClosureComputation& computation) {
  Hypothesis hypothesis;
  hypothesis.target_T_source = map_T_scan;
  const PreparedScanPtr view = views.from((map_T_scan * viewpoint.cast<double>()).cast<float>());
  MapVerification outcome;
  outcome.attempt = computation.follow(scan, *view, Guess(), hypothesis);
  outcome.overlap =
      agreement(scan, *view, outcome.attempt.result.target_T_source, kPartnerDistance_m).overlap;
  return outcome;
}

/** Registers the scan with the view from a place, and verifies the pose. */
MapVerification tryView(const PreparedScan& scan, const Vector3f& viewpoint, const Vector3f& place,
                        const Views& views, const LoopClosureComputation& computation) {
  MapVerification outcome;
  outcome.attempt = computation.compute(scan, *views.from(place), Guess());
  if (!outcome.attempt.accepted) return outcome;
  if (!isUpright(outcome.attempt.result.target_T_source)) {
    outcome.attempt.accepted = false;
    outcome.attempt.stage = "views of the map";
    outcome.attempt.reason = "the scan does not stand upright";
    return outcome;
  }
  MapVerification verified =
      verifyAt(scan, viewpoint, outcome.attempt.result.target_T_source, views, computation);
  verified.attempt.alignments = std::move(outcome.attempt.alignments);
  return verified;
}

size_t mostInliers(const LoopClosureAttempt& attempt) {
  size_t most = 0;
  for (const AlignerOutcome& outcome : attempt.alignments)
    for (const Hypothesis& hypothesis : outcome.alignment.hypotheses)
      most = std::max(most, hypothesis.inliers);
  return most;
}

/** Accepted ones first, by their overlap; then those with more matches; of equals the first. */
const MapVerification& bestOf(const std::vector<MapVerification>& outcomes) {
  return *std::max_element(outcomes.begin(), outcomes.end(),
                           [](const MapVerification& a, const MapVerification& b) {
                             if (a.attempt.accepted != b.attempt.accepted)
                               return b.attempt.accepted;
                             if (a.attempt.accepted) return a.overlap < b.overlap;
                             return mostInliers(a.attempt) < mostInliers(b.attempt);
                           });
}

bool agree(const MapVerification& a, const MapVerification& b, const AmbiguityOptions& options) {
  const Pose3 error = a.attempt.result.target_T_source.inverse() * b.attempt.result.target_T_source;
  return error.translation().norm() <= options.ambiguity_distance_m &&
         rotationAngle(error) * 180.0 / M_PI <= options.ambiguity_angle_deg;
}

/** How many of the accepted outcomes agree with one, itself included. */
size_t agreeingWith(const MapVerification& one, const std::vector<MapVerification>& outcomes,
                    const AmbiguityOptions& options) {
  return static_cast<size_t>(
      std::count_if(outcomes.begin(), outcomes.end(), [&](const MapVerification& other) {
        return other.attempt.accepted && agree(one, other, options);
      }));
}

void refuse(MapRegistration& registration, const std::string& reason) {
  registration.attempt.accepted = false;
  registration.attempt.stage = "views of the map";
  registration.attempt.reason = reason;
}

/** Refuses the best outcome unless it is to be believed. */
void judge(const MapVerification& best, const std::vector<MapVerification>& outcomes,
           const AmbiguityOptions& options, MapRegistration& registration) {
  registration.agreeing = agreeingWith(best, outcomes, options);
  if (!best.attempt.accepted) return;
  const bool has_rival =
      std::any_of(outcomes.begin(), outcomes.end(), [&](const MapVerification& outcome) {
        return outcome.attempt.accepted && !agree(outcome, best, options) &&
               outcome.overlap >= options.ambiguity_overlap * best.overlap &&
               agreeingWith(outcome, outcomes, options) >= kLeastAgreeing;
      });
  if (has_rival)
    refuse(registration, "they lead to different places that look alike");
  else if (registration.agreeing < kLeastAgreeing)
    refuse(registration, "too few of them lead to the same pose");
  else if (best.overlap < kLeastOverlap)
    refuse(registration, "they show too little of what the scan sees");
}

}  // namespace

MapRegistration registerOnMap(const PreparedScan& scan, const Vector3f& viewpoint,
                              const std::vector<Vector3f>& map, const SlamConfig& config) {
  MapRegistration registration;
  const Views views(map, rangeOf(scan, viewpoint), config);
  const LoopClosureComputation computation = config.makeLoopClosureComputation();
  const std::vector<Vector3f> places = viewpointsIn(map, heightOf(scan, viewpoint));
  registration.views = places.size();
  if (places.empty()) {
    refuse(registration, "nothing in the map looks like a floor with free space above it");
    return registration;
  }
  std::vector<MapVerification> outcomes(places.size());
  tbb::parallel_for(size_t{0}, places.size(), [&](size_t i) {
    outcomes[i] = tryView(scan, viewpoint, places[i], views, computation);
  });
  const MapVerification& best = bestOf(outcomes);
  registration.attempt = best.attempt;
  judge(best, outcomes, config.registration.ambiguity, registration);
  return registration;
}

MapVerification verifyOnMap(const PreparedScan& scan, const Vector3f& viewpoint,
                            const Pose3& map_T_scan, const std::vector<Vector3f>& map,
                            const SlamConfig& config) {
  const Views views(map, rangeOf(scan, viewpoint), config);
  return verifyAt(scan, viewpoint, map_T_scan, views, config.makeLoopClosureComputation());
}

}  // namespace lamp
