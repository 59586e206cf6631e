#include "lamp/simulation/Artifacts.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "SampleStamps.h"
#include "lamp/simulation/Random.h"

namespace lamp::simulation {
namespace {

struct View {
  double stamp;
  Eigen::Vector3d camera_p_artifact;
};

std::optional<View> viewAt(double stamp, const Eigen::Vector3d& artifact,
                           const TrajectoryInterpolator& truth, const RayCaster& caster,
                           const ArtifactOptions& options) {
  const Pose3 camera = truth.at(stamp) * Eigen::Translation3d(0, 0, options.camera_m);
  const Eigen::Vector3d seen = camera.inverse() * artifact;
  if (seen.norm() > options.range_m) return {};
  if (!caster.visible(camera.translation().cast<float>(), artifact.cast<float>())) return {};
  return View{stamp, seen};
}

/** The nearest view of each pass. */
std::vector<View> passesBy(const Artifact& artifact, const TrajectoryInterpolator& truth,
                           const RayCaster& caster, const ArtifactOptions& options) {
  std::vector<View> passes;
  double last_seen = -std::numeric_limits<double>::infinity();
  for (const double stamp : sampleStamps(truth, options.rate_hz)) {
    const auto view = viewAt(stamp, artifact.position, truth, caster, options);
    if (!view) continue;
    if (stamp - last_seen > options.pass_gap_s)
      passes.push_back(*view);
    else if (view->camera_p_artifact.norm() < passes.back().camera_p_artifact.norm())
      passes.back() = *view;
    last_seen = stamp;
  }
  return passes;
}

Sighting measure(const View& view, int id, const ArtifactOptions& options, Random& random) {
  const Eigen::Vector3d& p = view.camera_p_artifact;
  const double angle_sigma = options.angle_sigma_deg * M_PI / 180.0;
  Sighting sighting{view.stamp, id};
  sighting.range_m = std::max(0.0, p.norm() + normal(random, options.range_sigma_m));
  sighting.yaw_rad = std::atan2(p.y(), p.x()) + normal(random, angle_sigma);
  sighting.pitch_rad = -std::atan2(p.z(), std::hypot(p.x(), p.y())) + normal(random, angle_sigma);
  return sighting;
}

}  // namespace

void ArtifactOptions::visit(OptionVisitor& v) {
  v("range_m", range_m, "m", "distance within which an artifact is seen", kPositive);
  v("rate_hz", rate_hz, "Hz", "looks per second", kPositive);
  v("camera_m", camera_m, "m", "height of the camera above the base", kNotNegative);
  v("range_sigma_m", range_sigma_m, "m", "noise of the distance", kNotNegative);
  v("angle_sigma_deg", angle_sigma_deg, "deg", "noise of the two angles", kNotNegative);
  v("pass_gap_s", pass_gap_s, "s", "time out of sight that ends a pass", kPositive);
}

std::vector<Sighting> seeArtifacts(const std::vector<Artifact>& artifacts,
                                   const TrajectoryInterpolator& truth, const RayCaster& caster,
                                   const ArtifactOptions& options, uint64_t seed) {
  std::vector<Sighting> sightings;
  for (const Artifact& artifact : artifacts) {
    Random random(mixSeeds({seed, static_cast<uint64_t>(artifact.id)}));
    for (const View& view : passesBy(artifact, truth, caster, options))
      sightings.push_back(measure(view, artifact.id, options, random));
  }
  std::sort(sightings.begin(), sightings.end(), [](const Sighting& a, const Sighting& b) {
    return std::tie(a.stamp, a.id) < std::tie(b.stamp, b.id);
  });
  return sightings;
}

}  // namespace lamp::simulation
