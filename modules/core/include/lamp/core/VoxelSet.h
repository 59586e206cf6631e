#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace lamp {

/** The voxels of a regular grid that hold a point; 16 to 32 bytes a voxel. */
class VoxelSet {
 public:
  /** \param voxel_m edge of a voxel, metres, positive. */
  explicit VoxelSet(double voxel_m);

  /** \return true if the point is the first one in its voxel. \throws std::runtime_error if the
   * point lies more than 2^20 voxels from the origin. */
  bool insert(const Eigen::Vector3d& point);
  size_t size() const { return size_; }

 private:
  uint64_t keyOf(const Eigen::Vector3d& point) const;
  bool insertKey(uint64_t key);
  void grow();

  double voxel_m_;
  size_t size_ = 0;
  std::vector<uint64_t> slots_;  ///< open addressing, at most half full
};

}  // namespace lamp
