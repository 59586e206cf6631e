#include "CloudPoints.h"

#include <algorithm>
#include <limits>

#include "lamp/core/SurfaceNormals.h"
#include "lamp/core/VoxelKey.h"

namespace lamp {

namespace {

struct VoxelPoint {
  uint64_t voxel;
  uint32_t point;

  bool operator<(const VoxelPoint& o) const {
    return voxel != o.voxel ? voxel < o.voxel : point < o.point;
  }
};

using Group = std::vector<VoxelPoint>::const_iterator;

/** Of the points of one voxel, the one nearest to their mean. */
uint32_t nearestToMean(Group begin, Group end, const std::vector<CloudPoint>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (Group at = begin; at != end; ++at) mean += points[at->point].position.cast<double>();
  mean /= static_cast<double>(end - begin);
  uint32_t best = begin->point;
  double least = std::numeric_limits<double>::infinity();
  for (Group at = begin; at != end; ++at) {
    const double distance = (points[at->point].position.cast<double>() - mean).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    best = at->point;
  }
  return best;
}

bool isLevel(const std::vector<CloudPoint>& points) {
  constexpr float kThickness = 1e-3f;
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(),
      [](const auto& a, const auto& b) { return a.position.z() < b.position.z(); });
  return points.empty() || high->position.z() - low->position.z() < kThickness;
}

}  // namespace

Eigen::Vector3d sensorOf(const CloudPoint& point, const ComponentMap& map) {
  const MapKeyNode& key_node = map.key_nodes[point.key_node];
  const Scan& scan = *key_node.scan;
  return key_node.world_T_base * scan.sensors[scan.sensor[point.index]].position;
}

float intensityOf(const CloudPoint& point, const ComponentMap& map) {
  const Scan& scan = *map.key_nodes[point.key_node].scan;
  return scan.hasIntensity() ? scan.intensity[point.index]
                             : std::numeric_limits<float>::quiet_NaN();
}

void thinToMeans(std::vector<CloudPoint>& points, double voxel_m) {
  std::vector<VoxelPoint> by_voxel;
  by_voxel.reserve(points.size());
  for (uint32_t i = 0; i < points.size(); ++i)
    by_voxel.push_back({voxelKey(points[i].position.cast<double>(), voxel_m), i});
  std::sort(by_voxel.begin(), by_voxel.end());
  std::vector<uint32_t> kept;
  for (Group begin = by_voxel.begin(); begin != by_voxel.end();) {
    const Group end = std::find_if(begin, by_voxel.cend(), [&](const VoxelPoint& other) {
      return other.voxel != begin->voxel;
    });
    kept.push_back(nearestToMean(begin, end, points));
    begin = end;
  }
  std::sort(kept.begin(), kept.end());
  for (size_t i = 0; i < kept.size(); ++i) points[i] = points[kept[i]];
  points.resize(kept.size());
}

std::vector<Eigen::Vector3f> normalsOf(const std::vector<CloudPoint>& points,
                                       const ComponentMap& map) {
  constexpr int kNeighbors = 12;
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(points.size());
  for (const CloudPoint& point : points) positions.push_back(point.position);
  const KdTree tree(positions);
  std::vector<Eigen::Vector3f> normals =
      fitPlanes(positions, tree, kNeighbors, isLevel(points)).normals;
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f view = sensorOf(points[i], map).cast<float>() - positions[i];
    if (normals[i].dot(view) < 0) normals[i] = -normals[i];
  }
  return normals;
}

}  // namespace lamp
