#include "OctreeScanInserter.h"

#include <algorithm>

namespace lamp {

namespace {

octomap::point3d toOctomap(const Eigen::Vector3d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

/** Spreads the 16 bits of v so that two zeros follow each. */
uint64_t spread(uint64_t v) {
  v = (v | v << 16) & 0x0000FF0000FF;
  v = (v | v << 8) & 0x00F00F00F00F;
  v = (v | v << 4) & 0x0C30C30C30C3;
  return (v | v << 2) & 0x249249249249;
}

/** Inverse of spread(). */
octomap::key_type gather(uint64_t v) {
  v &= 0x249249249249;
  v = (v | v >> 2) & 0x0C30C30C30C3;
  v = (v | v >> 4) & 0x00F00F00F00F;
  v = (v | v >> 8) & 0x0000FF0000FF;
  return static_cast<octomap::key_type>(v | v >> 16);
}

uint64_t zOrder(const octomap::OcTreeKey& key) {
  return spread(key[0]) | spread(key[1]) << 1 | spread(key[2]) << 2;
}

octomap::OcTreeKey fromZOrder(uint64_t code) {
  return {gather(code), gather(code >> 1), gather(code >> 2)};
}

void sortUnique(std::vector<uint64_t>& codes) {
  std::sort(codes.begin(), codes.end());
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
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
    if (!cut) occupied_.push_back(zOrder(end_key));
    castRay(toOctomap(origin), toOctomap(end));
  }
}

void OctreeScanInserter::castRay(const octomap::point3d& origin, const octomap::point3d& end) {
  if (!tree_.computeRayKeys(origin, end, ray_)) return;
  for (const octomap::OcTreeKey& key : ray_) free_.push_back(zOrder(key));
}

void OctreeScanInserter::updateTree() {
  constexpr bool kLazy = true;
  sortUnique(free_);
  sortUnique(occupied_);
  for (const uint64_t code : free_)
    if (!std::binary_search(occupied_.begin(), occupied_.end(), code))
      tree_.updateNode(fromZOrder(code), false, kLazy);
  for (const uint64_t code : occupied_) tree_.updateNode(fromZOrder(code), true, kLazy);
}

}  // namespace lamp
