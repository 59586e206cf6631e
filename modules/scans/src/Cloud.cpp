#include "lamp/scans/Cloud.h"

#include <unordered_map>
#include <unordered_set>

#include "GridCell.h"

namespace lamp {

using Eigen::Vector3f;

bool isUsable(const Vector3f& point) {
  constexpr float kFarthest_m = 1e6f;
  return point.allFinite() && point.norm() < kFarthest_m;
}

Cloud cloudSeenFromOrigin(std::vector<Vector3f> points) {
  Cloud cloud;
  cloud.viewpoint.assign(points.size(), 0);
  cloud.points = std::move(points);
  cloud.viewpoints = {Vector3f::Zero()};
  return cloud;
}

Cloud accumulate(const std::vector<PlacedScan>& scans, double leaf_m) {
  Cloud cloud;
  std::unordered_set<GridCell, GridCellHash> filled;
  cloud.own_viewpoints = scans.empty() ? 0 : scans.front().scan->sensors.size();
  for (const PlacedScan& placed : scans) {
    const Eigen::Isometry3f T = placed.target_T_scan.cast<float>();
    const auto first_view = static_cast<uint32_t>(cloud.viewpoints.size());
    const size_t first_point = cloud.size();
    for (const SensorOrigin& sensor : placed.scan->sensors)
      cloud.viewpoints.push_back(T * sensor.position.cast<float>());
    for (size_t i = 0; i < placed.scan->size(); ++i) {
      const Vector3f point = T * placed.scan->points[i];
      if (!isUsable(point) || (first_point > 0 && filled.count(cellOf(point, leaf_m)))) continue;
      cloud.points.push_back(point);
      cloud.viewpoint.push_back(first_view + placed.scan->sensor[i]);
    }
    for (size_t i = first_point; i < cloud.size(); ++i)
      filled.insert(cellOf(cloud.points[i], leaf_m));
  }
  return cloud;
}

Cloud voxelMeans(const Cloud& cloud, double leaf_m) {
  std::unordered_map<GridCell, size_t, GridCellHash> place;
  place.reserve(cloud.size());
  std::vector<Eigen::Vector3d> sums;
  std::vector<int> counts;
  Cloud means;
  means.viewpoints = cloud.viewpoints;
  means.own_viewpoints = cloud.own_viewpoints;
  for (size_t i = 0; i < cloud.size(); ++i) {
    const auto [found, is_new] = place.emplace(cellOf(cloud.points[i], leaf_m), sums.size());
    if (is_new) {
      sums.push_back(Eigen::Vector3d::Zero());
      counts.push_back(0);
      means.viewpoint.push_back(cloud.viewpoint[i]);
    }
    sums[found->second] += cloud.points[i].cast<double>();
    ++counts[found->second];
  }
  for (size_t k = 0; k < sums.size(); ++k)
    means.points.push_back((sums[k] / counts[k]).cast<float>());
  return means;
}

void turnTowardsViewpoints(const Cloud& cloud, std::vector<Vector3f>& normals) {
  for (size_t i = 0; i < cloud.size(); ++i)
    if (normals[i].dot(cloud.viewpointOf(i) - cloud.points[i]) < 0) normals[i] = -normals[i];
}

}  // namespace lamp
