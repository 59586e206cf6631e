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

size_t sideOf(float right, float up) {
  const float turns = std::atan2(up, right) / static_cast<float>(2 * M_PI) + 1.0f;
  return static_cast<size_t>(std::lround(turns * kSides)) % kSides;
}

}  // namespace

/** The rays of all points that were seen from one place. */
class SurfaceSupport::Rays {
 public:
  Rays(const Cloud& cloud, uint32_t viewpoint, double noise_m)
      : cloud_(cloud),
        viewpoint_(cloud.viewpoints[viewpoint]),
        slack_m_(kDeviations * static_cast<float>(noise_m)),
        tree_(directions_) {
    for (uint32_t i = 0; i < cloud.size(); ++i) {
      const Vector3f ray = cloud.points[i] - viewpoint_;
      if (cloud.viewpoint[i] != viewpoint || !(ray.norm() > 0)) continue;
      points_.push_back(i);
      directions_.push_back(ray.normalized());
    }
    tree_ = KdTree(directions_);
  }

  Rays(const Rays&) = delete;  // the tree refers to the directions
  Rays& operator=(const Rays&) = delete;

  /** Whether the rays around a point's ray met the plane through the point, too. */
  bool meetPlane(uint32_t point, const Vector3f& normal, bool planar) const {
    const Vector3f ray = cloud_.points[point] - viewpoint_;
    if (!(ray.norm() > 0)) return false;
    const Vector3f direction = ray.normalized();
    thread_local std::vector<uint32_t> nearest;
    tree_.nearest(direction, kRays, nearest);
    const Vector3f right = planar ? direction.cross(Vector3f::UnitZ())
                                  : towardsNearest(point, direction, nearest).normalized();
    const Vector3f up = right.cross(direction);
    std::array<bool, kSides> seen{};
    size_t sides = 0, met = 0;
    for (const uint32_t other : nearest) {
      if (points_[other] == point) continue;
      const Vector3f apart = directions_[other] - direction;
      const size_t side = planar ? apart.dot(right) > 0 : sideOf(apart.dot(right), apart.dot(up));
      if (seen[side]) continue;
      seen[side] = true;
      ++sides;
      met += isOnPlane(point, points_[other], normal);
    }
    return sides >= (planar ? kMinSidesPlanar : kMinSides) &&
           static_cast<float>(met) >= kShare * static_cast<float>(sides);
  }

 private:
  /** Across the ray, to the nearest other one: along a ring, so that two sides are the ring's. */
  Vector3f towardsNearest(uint32_t point, const Vector3f& direction,
                          const std::vector<uint32_t>& nearest) const {
    for (const uint32_t other : nearest) {
      if (points_[other] == point) continue;
      const Vector3f across = directions_[other] - directions_[other].dot(direction) * direction;
      if (across.squaredNorm() > 0) return across;
    }
    return direction.unitOrthogonal();
  }

  bool isOnPlane(uint32_t point, uint32_t other, const Vector3f& normal) const {
    const Vector3f apart = cloud_.points[other] - cloud_.points[point];
    return std::abs(normal.dot(apart)) < std::max(slack_m_, kMaxSlope * apart.norm());
  }

  const Cloud& cloud_;
  const Vector3f viewpoint_;
  const float slack_m_;
  std::vector<uint32_t> points_;
  std::vector<Vector3f> directions_;
  KdTree tree_;
};

SurfaceSupport::SurfaceSupport(const Cloud& cloud, const std::vector<Vector3f>& normals,
                               double noise_m, bool planar)
    : cloud_(cloud),
      normals_(normals),
      noise_m_(noise_m),
      planar_(planar),
      answers_(cloud.size()) {}

SurfaceSupport::~SurfaceSupport() = default;

bool SurfaceSupport::at(size_t point) const {
  std::atomic<Answer>& answer = answers_[point];
  if (answer == Answer::kNotAsked)
    answer = computed(static_cast<uint32_t>(point)) ? Answer::kYes : Answer::kNo;
  return answer == Answer::kYes;
}

bool SurfaceSupport::computed(uint32_t point) const {
  if (normals_[point].isZero()) return false;
  std::call_once(rays_made_, [this] {
    for (uint32_t viewpoint = 0; viewpoint < cloud_.viewpoints.size(); ++viewpoint)
      rays_.push_back(std::make_unique<Rays>(cloud_, viewpoint, noise_m_));
  });
  return rays_[cloud_.viewpoint[point]]->meetPlane(point, normals_[point], planar_);
}

}  // namespace lamp
