#include "lamp/scans/Slide.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lamp {

namespace {

using Eigen::Vector3f;

/** A surface is across the axis if its normal is within 40 degrees of it. */
constexpr float kAcross = 0.77f;
constexpr size_t kMinPoints = 10, kMaxPoints = 300;
/** What lies farther than this before a surface is free space. */
constexpr float kMargin_m = 0.3f;
/** How far to the side the partner of a point may lie, in scans of coarseness 1, and how thick a
 * surface is along the axis. */
constexpr float kAside_m = 0.5f, kThickness_m = 0.5f;
/** Slides that differ by more are different; a smaller one is within reach of ICP. */
constexpr float kDifferent_m = 1.0f;
/** Another slide with more than this share of the best one's votes makes both doubtful. */
constexpr double kRival = 0.7;

/** Own points of a scan that lie on surfaces across the axis, in the target's frame. */
struct PointAcross {
  Vector3f position;
  bool looks_back;  ///< the surface's normal, against the axis
};

std::vector<PointAcross> pointsAcross(const PreparedScan& scan, const Eigen::Isometry3f& T,
                                      const Vector3f& axis) {
  std::vector<PointAcross> points;
  for (const uint32_t i : scan.own()) {
    const float along = (T.linear() * scan.normals()[i]).dot(axis);
    if (std::abs(along) > kAcross && scan.isOnSurface(i))
      points.push_back({T * scan.points()[i], along < 0});
  }
  if (points.size() <= kMaxPoints) return points;
  std::vector<PointAcross> some;
  for (size_t k = 0; k < kMaxPoints; ++k) some.push_back(points[k * points.size() / kMaxPoints]);
  return some;
}

/** Whether the other scan saw through many of the points of which it says anything; where a wall
 * meets others, its range image is too coarse to tell. */
bool contradicts(const std::vector<PointAcross>& points, const PreparedScan& other,
                 const Eigen::Isometry3f& other_T_target, float margin_m) {
  size_t free = 0, known = 0;
  for (const PointAcross& point : points) {
    const FreeSpace::Place place = other.freeSpace().at(other_T_target * point.position, margin_m);
    known += place != FreeSpace::Place::kUnknown;
    free += place == FreeSpace::Place::kFree;
  }
  return free >= kMinPoints && 4 * free > known;
}

/** How far apart along the axis points lie that could be one surface's, ascending. */
std::vector<float> slides(const std::vector<PointAcross>& source,
                          const std::vector<PointAcross>& target, const Vector3f& axis,
                          float aside_m) {
  std::vector<float> result;
  for (const PointAcross& s : source)
    for (const PointAcross& t : target) {
      if (s.looks_back != t.looks_back) continue;
      const Vector3f apart = t.position - s.position;
      const float along = apart.dot(axis);
      if ((apart - along * axis).norm() < aside_m) result.push_back(along);
    }
  std::sort(result.begin(), result.end());
  return result;
}

struct Votes {
  float slide = 0;
  size_t count = 0;
};

/** The interval as long as a surface is thick that holds most slides, away from `taken`. */
Votes mostVotes(const std::vector<float>& slides, std::optional<float> taken) {
  Votes best;
  size_t end = 0;
  for (size_t begin = 0; begin < slides.size(); ++begin) {
    while (end < slides.size() && slides[end] - slides[begin] < kThickness_m) ++end;
    const float middle = slides[begin + (end - begin) / 2];
    if (taken && std::abs(middle - *taken) < kDifferent_m) continue;
    if (end - begin > best.count) best = {middle, end - begin};
  }
  return best;
}

}  // namespace

std::optional<double> slideOntoSurfacesAcross(const PreparedScan& source,
                                              const PreparedScan& target,
                                              const Pose3& target_T_source,
                                              const Eigen::Vector3d& axis) {
  const Vector3f a = axis.cast<float>();
  const Eigen::Isometry3f T = target_T_source.cast<float>();
  const auto of_source = pointsAcross(source, T, a);
  const auto of_target = pointsAcross(target, Eigen::Isometry3f::Identity(), a);
  if (std::min(of_source.size(), of_target.size()) < kMinPoints) return std::nullopt;
  const auto scale = static_cast<float>(coarseness(source, target));
  if (!contradicts(of_source, target, Eigen::Isometry3f::Identity(), scale * kMargin_m) &&
      !contradicts(of_target, source, T.inverse(), scale * kMargin_m))
    return std::nullopt;
  const std::vector<float> all = slides(of_source, of_target, a, scale * kAside_m);
  const Votes best = mostVotes(all, std::nullopt);
  const auto rival = static_cast<double>(mostVotes(all, best.slide).count);
  if (best.count < kMinPoints || std::abs(best.slide) < kDifferent_m ||
      rival > kRival * static_cast<double>(best.count))
    return std::nullopt;
  return best.slide;
}

}  // namespace lamp
