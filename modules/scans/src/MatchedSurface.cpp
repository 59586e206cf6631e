#include "lamp/scans/MatchedSurface.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "IcpLinearization.h"
#include "PatchCount.h"
#include "lamp/scans/Observability.h"

namespace lamp {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/** This many points are enough to know the surfaces. */
constexpr size_t kPoints = 1500;
/** Along axes that are observed better than this, the pattern of a scan makes no difference: down a
 * smooth corridor it alone comes to 0.1. */
constexpr double kWeak = 0.15;
/** Least squared cosine between an axis and the normals that help to constrain it. */
constexpr double kHolds = 0.02;

struct Match {
  Vector3d source, target, normal, source_normal;  ///< in the target's frame
  size_t target_point;
};

std::vector<Match> matchesOf(const PreparedScan& source, const PreparedScan& target,
                             const Pose3& target_T_source, double distance_m) {
  const Eigen::Isometry3f T = target_T_source.cast<float>();
  std::vector<Match> matches;
  const size_t stride = std::max<size_t>(1, source.own().size() / kPoints);
  for (size_t k = 0; k < source.own().size(); k += stride) {
    const uint32_t i = source.own()[k];
    const Vector3f p = T * source.points()[i];
    const Vector3f normal = T.linear() * source.normals()[i];
    float squared;
    const size_t j = target.tree().nearest(p, static_cast<float>(distance_m), squared);
    if (j == KdTree::kNone || target.normals()[j].isZero() || target.normals()[j].dot(normal) < 0)
      continue;
    matches.push_back({p.cast<double>(), target.points()[j].cast<double>(),
                       target.normals()[j].cast<double>(), normal.cast<double>(), j});
  }
  return matches;
}

IcpNormalEquations sumOf(const std::vector<Match>& matches, const Vector3d& pivot, IcpMetric metric,
                         double kernel_m) {
  constexpr double kThickness = 0.01;
  Linearization sum(metric, kThickness, kernel_m);
  for (const Match& match : matches)
    sum.add(match.source - pivot, match.source - match.target, match.normal, match.source_normal);
  return sum.result();
}

/** Removes matches that are no surface but seem to constrain an axis that little else does. */
void dropPattern(const IcpNormalEquations& sum, double radius_m, const PreparedScan& target,
                 std::vector<Match>& matches) {
  const Observability observed = observability(sum.H, sum.weights, radius_m);
  const auto holdsWeakAxis = [&](const Vector3d& normal) {
    for (int k = 0; k < 3; ++k) {
      const double along = normal.dot(observed.translations.col(k));
      if (observed.translation[k] < kWeak && along * along > kHolds) return true;
    }
    return false;
  };
  matches.erase(std::remove_if(matches.begin(), matches.end(),
                               [&](const Match& match) {
                                 return holdsWeakAxis(match.normal) &&
                                        !target.isOnSurface(match.target_point);
                               }),
                matches.end());
}

}  // namespace

MatchedSurface matchedSurface(const PreparedScan& source, const PreparedScan& target,
                              const Pose3& target_T_source, double distance_m, double kernel_m) {
  const double scale = coarseness(source, target);
  MatchedSurface surface;
  surface.pivot = target_T_source * source.centroid();
  surface.radius_m = source.radius();
  std::vector<Match> matches = matchesOf(source, target, target_T_source, scale * distance_m);
  const auto sumOfAll = [&](IcpMetric metric) {
    return sumOf(matches, surface.pivot, metric, scale * kernel_m);
  };
  // By both normals edges keep their weight, and with it what they tell of the misfit.
  const IcpNormalEquations all = sumOfAll(IcpMetric::kPlaneToPlane);
  surface.residual_m = all.rms();
  dropPattern(sumOfAll(IcpMetric::kPointToPlane), surface.radius_m, target, matches);
  const IcpNormalEquations sum = sumOfAll(IcpMetric::kPointToPlane);
  surface.information = sum.H;
  surface.weights = sum.weights;
  PatchCount patches;
  for (const Match& match : matches) patches.add(match.source.cast<float>());
  surface.patches = patches.count();
  return surface;
}

}  // namespace lamp
