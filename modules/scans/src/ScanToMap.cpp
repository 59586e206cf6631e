#include "lamp/scans/ScanToMap.h"

#include <algorithm>
#include <cmath>

#include "Extent.h"
#include "IcpLinearization.h"
#include "PatchCount.h"

namespace lamp {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kMaxIterations = 30;
constexpr size_t kFewestMatches = 20;
/** In the coarse iterations about so many points take part, in the fine ones so many. */
constexpr size_t kCoarsePoints = 400, kFinePoints = 1500;
constexpr double kShrink = 0.6;
/** In the end points match within so many leaves, as the map's points lie one apart, and so many
 * standard deviations of its surfaces' noise. */
constexpr double kFinalLeaves = 2.0, kFinalDeviations = 4.0;
/** The kernel's width over the residuals' standard deviation, and its least, metres. */
constexpr double kKernelSigmas = 3.0, kLeastKernelM = 0.02;
constexpr double kToleranceM = 5e-4, kToleranceRad = 2e-4;
/** Steps below so many tolerances end the coarse iterations. */
constexpr double kCoarseTolerance = 10;

struct Match {
  Vector3f point;  ///< in the map's frame
  const LocalMap::Surface* surface;

  float residual() const { return surface->normal.dot(point - surface->center); }
};

std::vector<Match> matchesOf(const std::vector<Vector3f>& points, size_t stride, const Pose3& pose,
                             double max_distance_m, LocalMap& map) {
  const Eigen::Isometry3f T = pose.cast<float>();
  std::vector<Match> matches;
  for (size_t i = 0; i < points.size(); i += stride) {
    const Vector3f p = T * points[i];
    if (const auto* surface = map.surfaceNear(p, static_cast<float>(max_distance_m)))
      matches.push_back({p, surface});
  }
  return matches;
}

/** Standard deviation of the residuals by their median. */
double deviationOf(const std::vector<Match>& matches) {
  std::vector<float> residuals;
  for (const Match& match : matches) residuals.push_back(std::abs(match.residual()));
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return 1.4826 * *middle;
}

IcpNormalEquations sumOf(const std::vector<Match>& matches, const Vector3d& pivot,
                         double kernel_m) {
  Linearization sum(IcpMetric::kPointToPlane, 0, kernel_m);
  for (const Match& match : matches) {
    const Vector3d normal = match.surface->normal.cast<double>();
    sum.add(match.point.cast<double>() - pivot,
            (match.point - match.surface->center).cast<double>(), normal, normal);
  }
  return sum.result();
}

/** Motions that hardly any point stands in the way of would follow the noise, and never end. */
IcpNormalEquations damped(IcpNormalEquations sum, double radius_m) {
  constexpr double kShare = 0.001;
  sum.H.diagonal().head<3>().array() += kShare * sum.weights;
  sum.H.diagonal().tail<3>().array() += 0.2 * kShare * sum.weights * radius_m * radius_m;
  return sum;
}

}  // namespace

ScanToMapResult registerToMap(const std::vector<Vector3f>& points, LocalMap& map,
                              const Pose3& predicted, double max_error_m) {
  ScanToMapResult result;
  result.map_T_scan = predicted;
  if (points.size() < kFewestMatches) return result;
  const auto [centroid, radius] = extentOf(points);
  const double final_distance =
      std::max(kFinalLeaves * map.leaf(), kFinalDeviations * map.deviation());
  double distance = std::max(final_distance, max_error_m);
  size_t stride = std::max<size_t>(1, points.size() / kCoarsePoints);
  const size_t fine_stride = std::max<size_t>(1, points.size() / kFinePoints);
  IcpNormalEquations sum;
  for (int iteration = 0; iteration < kMaxIterations && !result.converged; ++iteration) {
    const Vector3d pivot = result.map_T_scan * centroid;
    const auto matches = matchesOf(points, stride, result.map_T_scan, distance, map);
    if (matches.size() < kFewestMatches) return result;
    result.deviation_m = deviationOf(matches);
    const double kernel = std::max(kLeastKernelM, kKernelSigmas * result.deviation_m);
    sum = sumOf(matches, pivot, kernel);
    const Vector6d step = solveStep(damped(sum, radius), map.planar());
    if (!step.allFinite()) return result;
    result.map_T_scan = movedAbout(pivot, step, result.map_T_scan);
    const double size =
        std::max(step.head<3>().norm() / kToleranceM, step.tail<3>().norm() / kToleranceRad);
    if (distance > final_distance)
      distance = std::max(final_distance, kShrink * distance);
    else if (stride > fine_stride)
      stride = size < kCoarseTolerance ? fine_stride : stride;
    else if (size < 1 || iteration + 1 == kMaxIterations) {
      result.converged = size < kCoarseTolerance;
      result.matched_share =
          static_cast<double>(matches.size() * stride) / static_cast<double>(points.size());
      PatchCount patches;
      for (const Match& match : matches) patches.add(match.point);
      result.surface = {sum.H, pivot, sum.weights, patches.count(), radius, sum.rms()};
      return result;
    }
  }
  return result;
}

}  // namespace lamp
