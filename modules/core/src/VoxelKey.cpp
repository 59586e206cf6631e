#include "lamp/core/VoxelKey.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace lamp {

uint64_t voxelKey(const Eigen::Vector3d& point, double voxel_m) {
  constexpr int kBitsPerAxis = 21;
  constexpr double kHalfSpan = 1 << (kBitsPerAxis - 1);
  uint64_t key = 0;
  for (const double coordinate : point) {
    const double cell = std::floor(coordinate / voxel_m);
    if (!(std::abs(cell) < kHalfSpan))
      throw std::runtime_error("a point at " + std::to_string(coordinate) +
                               " m is too far from the origin for voxels of " +
                               std::to_string(voxel_m) + " m: raise voxel_m or set it to 0");
    key = (key << kBitsPerAxis) | static_cast<uint64_t>(cell + kHalfSpan);
  }
  return key;
}

}  // namespace lamp
