#include "lamp/simulation/FreeSpace.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lamp::simulation {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kBumpsM = 1.6, kWavesM = 12.0;
constexpr int kBumpOctaves = 3;

double roughnessOf(const WallStyle& style) {
  return 1.5 * style.roughness_m + style.waviness_m;
}

/** Signed distance of a box whose sides lie at `excess` zero. */
double boxDistance(double excess_u, double excess_v) {
  return std::hypot(std::max(excess_u, 0.0), std::max(excess_v, 0.0)) +
         std::min(std::max(excess_u, excess_v), 0.0);
}

double distanceTo(const Pillar& pillar, const Vector3d& p) {
  const Vector2d offset = (p - pillar.foot).head<2>();
  const double sideways = pillar.square ? offset.cwiseAbs().maxCoeff() : offset.norm();
  const double height = p.z() - pillar.foot.z();
  return boxDistance(sideways - pillar.radius_m,
                     std::abs(height - 0.5 * pillar.height_m) - 0.5 * pillar.height_m);
}

Eigen::AlignedBox3d boxOf(const Pillar& pillar) {
  const Vector3d reach(pillar.radius_m, pillar.radius_m, 0);
  return {pillar.foot - reach, pillar.foot + reach + Vector3d(0, 0, pillar.height_m)};
}

Eigen::AlignedBox3d widened(const Eigen::AlignedBox3d& box, double by) {
  return {box.min() - Vector3d::Constant(by), box.max() + Vector3d::Constant(by)};
}

}  // namespace

void FreeSpace::add(const Hollow& hollow) {
  const Vector2d axis = (hollow.to - hollow.from).head<2>();
  const double length = axis.norm(), across = 0.5 * hollow.width_m + hollow.level_m;
  Eigen::AlignedBox3d box(hollow.from.cwiseMin(hollow.to), hollow.from.cwiseMax(hollow.to));
  box.min() -= Vector3d(across, across, 0);
  box.max() += Vector3d(across, across, hollow.height_m);
  hollows_.push_back(hollow);
  axes_.push_back({length > 0 ? Vector2d(axis / length) : Vector2d(1, 0), length});
  boxes_.push_back(box);
  roughness_m_ = std::max(roughness_m_, roughnessOf(hollow.style));
}

void FreeSpace::add(const Pillar& pillar) {
  pillars_.push_back(pillar);
}

Eigen::AlignedBox3d FreeSpace::bounds() const {
  Eigen::AlignedBox3d all;
  for (const auto& box : boxes_) all.extend(box);
  return widened(all, roughness_m_);
}

FreeSpace::Parts FreeSpace::partsIn(const Eigen::AlignedBox3d& box) const {
  const double reach = roughness_m_ + 0.5;
  const Eigen::AlignedBox3d wide = widened(box, reach);
  Parts parts;
  for (size_t i = 0; i < boxes_.size(); ++i)
    if (boxes_[i].intersects(widened(box, reach + hollows_[i].style.blend_m)))
      parts.hollows.push_back(i);
  for (size_t i = 0; i < pillars_.size(); ++i)
    if (boxOf(pillars_[i]).intersects(wide)) parts.pillars.push_back(i);
  return parts;
}

Vector3d FreeSpace::localOf(size_t i, const Vector3d& p) const {
  const Hollow& hollow = hollows_[i];
  const auto& [direction, length] = axes_[i];
  const Vector2d offset = (p - hollow.from).head<2>();
  const double along = direction.dot(offset);
  const double share = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
  const double floor = hollow.from.z() + share * (hollow.to.z() - hollow.from.z());
  return {along - 0.5 * length, direction.x() * offset.y() - direction.y() * offset.x(),
          p.z() - floor};
}

double FreeSpace::aboveFloor(size_t hollow, const Vector3d& p) const {
  return std::clamp(localOf(hollow, p).z() / 0.6, 0.0, 1.0);
}

double FreeSpace::distanceTo(size_t i, const Vector3d& p) const {
  const Hollow& hollow = hollows_[i];
  const Vector3d local = localOf(i, p);
  const double r = hollow.corner_m;
  const double section =
      boxDistance(std::abs(local.y()) - 0.5 * hollow.width_m + r,
                  std::abs(local.z() - 0.5 * hollow.height_m) - 0.5 * hollow.height_m + r);
  return boxDistance(section, std::abs(local.x()) - 0.5 * axes_[i].length - hollow.level_m + r) - r;
}

FreeSpace::Sample FreeSpace::smooth(const Vector3d& p, const Parts& parts) const {
  Sample nearest{std::numeric_limits<double>::infinity(), parts.hollows.front()};
  Sample second = nearest;
  for (const size_t i : parts.hollows) {
    const Sample sample{distanceTo(i, p), i};
    if (sample.distance_m < nearest.distance_m) {
      second = nearest;
      nearest = sample;
    } else if (sample.distance_m < second.distance_m) {
      second = sample;
    }
  }
  const double blend =
      aboveFloor(nearest.hollow, p) *
      std::min(hollows_[nearest.hollow].style.blend_m, hollows_[second.hollow].style.blend_m);
  if (const double overlap = blend - (second.distance_m - nearest.distance_m); overlap > 0)
    nearest.distance_m -= overlap * overlap / (4 * blend);
  for (const size_t i : parts.pillars)
    nearest.distance_m = std::max(nearest.distance_m, -lamp::simulation::distanceTo(pillars_[i], p));
  return nearest;
}

double FreeSpace::rough(const Vector3d& p, const Sample& sample) const {
  const WallStyle& style = hollows_[sample.hollow].style;
  // Away from the wall roughness decides nothing, and noise takes time.
  constexpr double kSlackM = 0.6;
  if (std::abs(sample.distance_m) > roughnessOf(style) + kSlackM) return sample.distance_m;
  const double share = style.floor_share + (1.0 - style.floor_share) * aboveFloor(sample.hollow, p);
  double change = 0;
  if (style.roughness_m > 0) change += style.roughness_m * noise_.fractal(p, kBumpsM, kBumpOctaves);
  if (style.waviness_m > 0) change += style.waviness_m * noise_.at(p, kWavesM);
  return sample.distance_m + share * change;
}

}  // namespace lamp::simulation
