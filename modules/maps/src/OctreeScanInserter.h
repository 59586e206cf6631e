#pragma once

#include <octomap/OcTree.h>

#include <cstdint>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/core/KeyedScan.h"

namespace lamp {

/** Puts keyed scans into an octree. Call `tree.updateInnerOccupancy()` after the last one. */
class OctreeScanInserter {
 public:
  OctreeScanInserter(octomap::OcTree& tree, double max_range_m)
      : tree_(tree), max_range_m_(max_range_m) {}

  void insert(const Scan& scan, const Pose3& world_T_base);
  /** Rays left out so far because an end lies beyond the reach of 16-bit voxel keys. */
  size_t raysOutOfBounds() const { return rays_out_of_bounds_; }

 private:
  void castSensor(const Scan& scan, uint8_t sensor, const Pose3& world_T_base);
  void castRay(const octomap::point3d& origin, const octomap::point3d& end);
  void updateTree();

  octomap::OcTree& tree_;
  double max_range_m_;
  size_t rays_out_of_bounds_ = 0;
  // Voxels by their place on a Z-order curve; sorted, so that the tree is walked from neighbour to
  // neighbour. Members only to keep their memory from scan to scan.
  std::vector<uint64_t> free_, occupied_;
  octomap::KeySet hit_ends_, cut_ends_;  ///< ends of this sensor's rays so far
  octomap::KeyRay ray_;
};

}  // namespace lamp
