#include "lamp/scans/LocalMap.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "lamp/scans/Cloud.h"

namespace lamp {

namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

/** Blocks are this many leaves wide: few to look into, and few points in each. */
constexpr double kLeavesPerBlock = 5.0;
/** Surfaces are fitted to points within so many leaves; where these show none, since they are too
 * few, lie on the line that one ring of a lidar draws, or are too noisy, within twice as many; in
 * the plane, where that costs little, again and again. */
constexpr float kNearLeaves = 2.5f;
constexpr int kDoublings = 2, kPlanarDoublings = 3;
/** Of the surfaces' mean deviation, what each new one counts for. */
constexpr double kNewShare = 1.0 / 256;
constexpr size_t kFewestForPlane = 8, kFewestForLine = 4;
/** Points on a surface are spread along it by these factors more than across it, and than in their
 * other direction along it; variances. */
constexpr float kFlat = 4.0f, kLong = 0.01f;
/** Coordinates of blocks must fit into 21 bits each. */
constexpr float kMaxBlock = 1 << 20;

uint64_t packed(int64_t x, int64_t y, int64_t z) {
  constexpr uint64_t kMask = (uint64_t{1} << 21) - 1;
  return (static_cast<uint64_t>(x) & kMask) << 42 | (static_cast<uint64_t>(y) & kMask) << 21 |
         (static_cast<uint64_t>(z) & kMask);
}

}  // namespace

LocalMap::LocalMap(double leaf_m, bool planar)
    : leaf_m_(leaf_m), planar_(planar), block_m_(static_cast<float>(kLeavesPerBlock * leaf_m)) {}

uint64_t LocalMap::keyOf(const Vector3f& point) const {
  const Vector3f block = (point / block_m_).array().floor();
  return packed(static_cast<int64_t>(block.x()), static_cast<int64_t>(block.y()),
                static_cast<int64_t>(block.z()));
}

/** The points of all blocks within the radius, and some beyond it. */
template <class Visit>
void LocalMap::visitNear(const Vector3f& center, float radius, Visit&& visit) {
  const Vector3f reach = planar_ ? Vector3f(radius, radius, 0) : Vector3f::Constant(radius);
  const Vector3f low = ((center - reach) / block_m_).array().floor();
  const Vector3f high = ((center + reach) / block_m_).array().floor();
  for (auto x = static_cast<int64_t>(low.x()); x <= static_cast<int64_t>(high.x()); ++x)
    for (auto y = static_cast<int64_t>(low.y()); y <= static_cast<int64_t>(high.y()); ++y)
      for (auto z = static_cast<int64_t>(low.z()); z <= static_cast<int64_t>(high.z()); ++z) {
        const auto found = blocks_.find(packed(x, y, z));
        if (found == blocks_.end()) continue;
        for (MapPoint& point : found->second.points) visit(point, found->second);
      }
}

bool LocalMap::isFree(const Block& block, const Vector3f& point) const {
  const auto leaf = static_cast<float>(leaf_m_);
  return std::none_of(block.points.begin(), block.points.end(), [&](const MapPoint& other) {
    return (other.position - point).squaredNorm() < leaf * leaf;
  });
}

void LocalMap::add(const std::vector<Vector3f>& points, const Pose3& map_T_points,
                   const Vector3f& origin, double travelled_m) {
  ++revision_;
  const Eigen::Isometry3f T = map_T_points.cast<float>();
  const Vector3f seen_from = T * origin;
  for (const Vector3f& point : points) {
    const Vector3f p = T * point;
    if (!isUsable(p) || p.cwiseAbs().maxCoeff() >= kMaxBlock * block_m_) continue;
    Block& block = blocks_[keyOf(p)];
    block.seen_m = travelled_m;
    if (!isFree(block, p)) continue;
    if (block.points.empty()) block.order = next_order_++;
    MapPoint added;
    added.position = p;
    added.origin = seen_from;
    block.points.push_back(added);
    block.changed_at = revision_;
    ++points_;
  }
}

void LocalMap::forget(double travelled_m, const Vector3f& robot, double radius_m) {
  for (auto entry = blocks_.begin(); entry != blocks_.end();) {
    const Block& block = entry->second;
    const bool far = (block.points.front().position - robot).norm() > radius_m;
    if (block.seen_m >= travelled_m && !far) {
      ++entry;
      continue;
    }
    points_ -= block.points.size();
    entry = blocks_.erase(entry);
  }
}

/** The query's own block first: what is found there spares most of the others. */
LocalMap::MapPoint* LocalMap::nearest(const Vector3f& query, float max_distance_m,
                                      uint32_t& changed_at) {
  MapPoint* nearest = nullptr;
  float least = max_distance_m * max_distance_m;
  const auto look = [&](const Vector3f& at) {
    const auto found = blocks_.find(packed(
        static_cast<int64_t>(at.x()), static_cast<int64_t>(at.y()), static_cast<int64_t>(at.z())));
    if (found == blocks_.end()) return;
    for (MapPoint& point : found->second.points) {
      const float squared = (point.position - query).squaredNorm();
      if (squared >= least) continue;
      least = squared;
      nearest = &point;
      changed_at = found->second.changed_at;
    }
  };
  const Vector3f own = (query / block_m_).array().floor();
  look(own);
  const Vector3f reach =
      planar_ ? Vector3f(max_distance_m, max_distance_m, 0) : Vector3f::Constant(max_distance_m);
  const Vector3f low = ((query - reach) / block_m_).array().floor();
  const Vector3f high = ((query + reach) / block_m_).array().floor();
  for (float x = low.x(); x <= high.x(); ++x)
    for (float y = low.y(); y <= high.y(); ++y)
      for (float z = low.z(); z <= high.z(); ++z) {
        const Vector3f at(x, y, z), corner = block_m_ * at;
        const Vector3f inside =
            query.cwiseMax(corner).cwiseMin(corner + Vector3f::Constant(block_m_));
        if (at != own && (inside - query).squaredNorm() < least) look(at);
      }
  return nearest;
}

const LocalMap::Surface* LocalMap::surfaceNear(const Vector3f& query, float max_distance_m) {
  uint32_t changed_at = 0;
  MapPoint* const point = nearest(query, max_distance_m, changed_at);
  if (!point) return nullptr;
  if (point->fitted_at < changed_at) fit(*point);
  return point->surface.normal.isZero() ? nullptr : &point->surface;
}

void LocalMap::fit(MapPoint& point) {
  point.fitted_at = revision_;
  point.surface = {};
  float radius = kNearLeaves * static_cast<float>(leaf_m_);
  for (int doublings = planar_ ? kPlanarDoublings : kDoublings; doublings >= 0; --doublings) {
    if (fitWithin(radius, point)) {
      deviation_m_ += kNewShare * (point.surface.deviation_m - deviation_m_);
      return;
    }
    radius *= 2;
  }
}

bool LocalMap::fitWithin(float radius, MapPoint& point) {
  neighbors_.clear();
  visitNear(point.position, radius, [&](const MapPoint& other, const Block&) {
    if ((other.position - point.position).squaredNorm() <= radius * radius)
      neighbors_.push_back(other.position);
  });
  if (neighbors_.size() < (planar_ ? kFewestForLine : kFewestForPlane)) return false;
  Vector3f mean = Vector3f::Zero();
  for (const Vector3f& p : neighbors_) mean += p;
  mean /= static_cast<float>(neighbors_.size());
  Matrix3f scatter = Matrix3f::Zero();
  for (const Vector3f& p : neighbors_) scatter.noalias() += (p - mean) * (p - mean).transpose();
  scatter /= static_cast<float>(neighbors_.size());

  Vector3f normal;
  float across;
  if (planar_) {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2f> eigen;
    eigen.computeDirect(scatter.topLeftCorner<2, 2>());
    if (!(eigen.eigenvalues()[1] > kFlat * eigen.eigenvalues()[0])) return false;
    normal << eigen.eigenvectors().col(0), 0.0f;
    across = eigen.eigenvalues()[0];
  } else {
    Eigen::SelfAdjointEigenSolver<Matrix3f> eigen;
    eigen.computeDirect(scatter);
    const Vector3f values = eigen.eigenvalues();
    if (!(values[1] > kFlat * values[0] && values[1] > kLong * values[2])) return false;
    normal = eigen.eigenvectors().col(0);
    across = values[0];
  }
  if (!normal.allFinite()) return false;
  normal.normalize();
  if (normal.dot(point.origin - point.position) < 0) normal = -normal;
  point.surface = {mean, normal, std::sqrt(std::max(0.0f, across))};
  return true;
}

std::vector<Vector3f> LocalMap::points() const {
  std::vector<const Block*> blocks;
  for (const auto& [key, block] : blocks_) blocks.push_back(&block);
  std::sort(blocks.begin(), blocks.end(),
            [](const Block* a, const Block* b) { return a->order < b->order; });
  std::vector<Vector3f> result;
  for (const Block* block : blocks)
    for (const MapPoint& point : block->points) result.push_back(point.position);
  return result;
}

}  // namespace lamp
