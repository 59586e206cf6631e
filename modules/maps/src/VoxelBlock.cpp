#include "VoxelBlock.h"

#include <algorithm>
#include <cmath>

namespace lamp {

namespace {

/** Spreads the 16 bits of v so that two zeros follow each. */
uint64_t spread(uint64_t v) {
  v = (v | v << 16) & 0x0000FF0000FF;
  v = (v | v << 8) & 0x00F00F00F00F;
  v = (v | v << 4) & 0x0C30C30C30C3;
  return (v | v << 2) & 0x249249249249;
}

/** Inverse of spread(). */
int gather(uint64_t v) {
  v &= 0x249249249249;
  v = (v | v >> 2) & 0x0C30C30C30C3;
  v = (v | v >> 4) & 0x00F00F00F00F;
  v = (v | v >> 8) & 0x0000FF0000FF;
  return static_cast<int>((v | v >> 16) & 0xFFFF);
}

}  // namespace

BlockKey blockOf(const VoxelIndex& voxel) {
  const auto along = [](int index) {
    return spread(static_cast<uint64_t>((index + kGridReach) / kBlockSide));
  };
  return along(voxel.x()) | along(voxel.y()) << 1 | along(voxel.z()) << 2;
}

VoxelIndex firstVoxelOf(BlockKey block) {
  const auto along = [](uint64_t bits) { return gather(bits) * kBlockSide - kGridReach; };
  return {along(block), along(block >> 1), along(block >> 2)};
}

int voxelsIn(double length_m, double resolution_m) {
  constexpr double kRounding = 1e-9;
  return std::max(1, static_cast<int>(std::ceil(length_m / resolution_m - kRounding)));
}

}  // namespace lamp
