#include "OctreeScanInserter.h"

namespace lamp {

namespace {

octomap::point3d toOctomap(const Eigen::Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

}  // namespace

void OctreeScanInserter::insert(const Scan& scan, const Pose3& world_T_base) {
  free_.clear();
  occupied_.clear();
  for (size_t sensor = 0; sensor < scan.sensors.size(); ++sensor)
    castSensor(scan, static_cast<uint8_t>(sensor), world_T_base);
  updateTree();
}

void OctreeScanInserter::castSensor(const Scan& scan, uint8_t sensor, const Pose3& world_T_base) {
  hit_ends_.clear();
  cut_ends_.clear();
  const Eigen::Vector3d origin = world_T_base * scan.sensors[sensor].position;
  for (size_t i = 0; i < scan.size(); ++i) {
    if (scan.sensor[i] != sensor) continue;
    const Eigen::Vector3d point = world_T_base * scan.points[i].cast<double>();
    if (!point.allFinite()) continue;
    const double range = (point - origin).norm();
    const bool cut = range > max_range_m_;
    const Eigen::Vector3d end = cut ? origin + (point - origin) * (max_range_m_ / range) : point;

    octomap::OcTreeKey origin_key, end_key;
    if (!tree_.coordToKeyChecked(toOctomap(origin), origin_key) ||
        !tree_.coordToKeyChecked(toOctomap(end), end_key)) {
      ++rays_out_of_bounds_;
      continue;
    }
    // Rays from one origin into one voxel pass nearly the same voxels: the first stands for all.
    if (!(cut ? cut_ends_ : hit_ends_).insert(end_key).second) continue;
    if (!cut) occupied_.insert(end_key);
    castRay(toOctomap(origin), toOctomap(end));
  }
}

void OctreeScanInserter::castRay(const octomap::point3d& origin, const octomap::point3d& end) {
  if (tree_.computeRayKeys(origin, end, ray_)) free_.insert(ray_.begin(), ray_.end());
}

void OctreeScanInserter::updateTree() {
  constexpr bool kLazy = true;
  for (const octomap::OcTreeKey& key : free_)
    if (occupied_.count(key) == 0) tree_.updateNode(key, false, kLazy);
  for (const octomap::OcTreeKey& key : occupied_) tree_.updateNode(key, true, kLazy);
}

}  // namespace lamp
