#include "lamp/scans/SurfaceSupport.h"

#include <array>
#include <cmath>

#include "lamp/core/KdTree.h"

namespace lamp {

namespace {

using Eigen::Vector3f;

/** Among so many nearest rays the nearest one on each side is sought; where a scan is a set of
 * rings, nearer ones would all lie on the same ring. */
constexpr size_t kRays = 32;
/** Sides of a ray, each 60 degrees wide. */
constexpr size_t kSides = 6;
constexpr size_t kMinSides = 3, kMinSidesPlanar = 1;
/** How many of the sides where there is a ray must have met the surface. */
constexpr float kShare = 0.75f;
/** How far off the tangent plane a surface may lead: this share of the distance (20 degrees), or so
 * many standard deviations of noise where points lie close together. */
constexpr float kMaxSlope = 0.35f, kDeviations = 3.0f;

/** The rays of all points that were seen from one place. */
class Rays {
 public:
  Rays(const Cloud& cloud, uint32_t viewpoint, double noise_m)
      : cloud_(cloud), slack_m_(kDeviations * static_cast<float>(noise_m)), tree_(directions_) {
    for (uint32_t i = 0; i < cloud.size(); ++i) {
      const Vector3f ray = cloud.points[i] - cloud.viewpoints[viewpoint];
      if (cloud.viewpoint[i] != viewpoint || !(ray.norm() > 0)) continue;
      points_.push_back(i);
      directions_.push_back(ray.normalized());
    }
    tree_ = KdTree(directions_);
  }

  size_t size() const { return points_.size(); }
  uint32_t point(size_t ray) const { return points_[ray]; }

  /** Whether the rays around the `ray`-th one met the plane through its end, too. */
  bool support(size_t ray, const Vector3f& normal, bool planar) {
    tree_.nearest(directions_[ray], kRays, nearest_);
    const Vector3f right =
        planar ? directions_[ray].cross(Vector3f::UnitZ()) : towardsNearest(ray).normalized();
    const Vector3f up = right.cross(directions_[ray]);
    std::array<bool, kSides> seen{};
    size_t sides = 0, met = 0;
    for (const uint32_t other : nearest_) {
      if (other == ray) continue;
      const Vector3f apart = directions_[other] - directions_[ray];
      const size_t side = planar ? apart.dot(right) > 0 : sideOf(apart.dot(right), apart.dot(up));
      if (seen[side]) continue;
      seen[side] = true;
      ++sides;
      met += isOnPlane(points_[ray], points_[other], normal);
    }
    return sides >= (planar ? kMinSidesPlanar : kMinSides) &&
           static_cast<float>(met) >= kShare * static_cast<float>(sides);
  }

 private:
  /** Across the ray, to the nearest other one: along a ring, so that two sides are the ring's. */
  Vector3f towardsNearest(size_t ray) const {
    const Vector3f& direction = directions_[ray];
    for (const uint32_t other : nearest_) {
      if (other == ray) continue;
      const Vector3f across = directions_[other] - directions_[other].dot(direction) * direction;
      if (across.squaredNorm() > 0) return across;
    }
    return direction.unitOrthogonal();
  }

  static size_t sideOf(float right, float up) {
    const float turns = std::atan2(up, right) / static_cast<float>(2 * M_PI) + 1.0f;
    return static_cast<size_t>(std::lround(turns * kSides)) % kSides;
  }

  bool isOnPlane(uint32_t point, uint32_t other, const Vector3f& normal) const {
    const Vector3f apart = cloud_.points[other] - cloud_.points[point];
    return std::abs(normal.dot(apart)) < std::max(slack_m_, kMaxSlope * apart.norm());
  }

  const Cloud& cloud_;
  const float slack_m_;
  std::vector<uint32_t> points_;
  std::vector<Vector3f> directions_;
  KdTree tree_;
  std::vector<uint32_t> nearest_;
};

}  // namespace

std::vector<uint8_t> surfaceSupport(const Cloud& cloud, const std::vector<Vector3f>& normals,
                                    double noise_m, bool planar) {
  std::vector<uint8_t> support(cloud.size(), 0);
  for (uint32_t viewpoint = 0; viewpoint < cloud.viewpoints.size(); ++viewpoint) {
    Rays rays(cloud, viewpoint, noise_m);
    for (size_t ray = 0; ray < rays.size(); ++ray) {
      const uint32_t point = rays.point(ray);
      if (!normals[point].isZero())
        support[point] = rays.support(ray, normals[point], planar) ? 1 : 0;
    }
  }
  return support;
}

}  // namespace lamp
