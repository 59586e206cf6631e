#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace lamp {

/** A voxel by its place in a grid through the origin: floor(coordinate / edge). */
using VoxelIndex = Eigen::Vector3i;

/** Voxels are kept in cubes of this many a side, so that one layer is the bits of one word. */
constexpr int kBlockSide = 8;
constexpr size_t kBlockVoxels = 512;
/** Voxels from the origin to the end of the grid: OctoMap's keys have 16 bits. */
constexpr int kGridReach = 1 << 15;

/** Names a block by its place on a Z-order curve, as octrees walk them; 13 bits for each axis, x
 * lowest. */
using BlockKey = uint64_t;

BlockKey blockOf(const VoxelIndex& voxel);
/** The voxel with the least coordinates of the block. */
VoxelIndex firstVoxelOf(BlockKey block);

inline VoxelIndex voxelAt(const Eigen::Vector3d& point_in_voxels) {
  return point_in_voxels.array().floor().cast<int>();
}
/** Voxels that a length takes, at least one; 0.8 m are four voxels of 0.2 m, whatever the rounding.
 */
int voxelsIn(double length_m, double resolution_m);
/** Names the column of voxels above each other. */
inline uint64_t columnKey(int x, int y) {
  return uint64_t{static_cast<uint32_t>(x)} << 32 | static_cast<uint32_t>(y);
}
inline bool isInGrid(const VoxelIndex& voxel) {
  return (voxel.array() >= -kGridReach).all() && (voxel.array() < kGridReach).all();
}

/** Place of a voxel within its block: x fastest, z slowest. */
inline size_t placeInBlock(const VoxelIndex& voxel) {
  constexpr int kMask = kBlockSide - 1;
  return static_cast<size_t>(((voxel.z() & kMask) * kBlockSide + (voxel.y() & kMask)) * kBlockSide +
                             (voxel.x() & kMask));
}
inline VoxelIndex fromPlaceInBlock(size_t place) {
  const auto i = static_cast<int>(place);
  return {i % kBlockSide, i / kBlockSide % kBlockSide, i / kBlockSide / kBlockSide};
}

/** Names a voxel of the grid. */
inline uint64_t voxelKey(const VoxelIndex& voxel) {
  return blockOf(voxel) * kBlockVoxels + placeInBlock(voxel);
}

/** One bit for each voxel of a block, by its place. */
struct VoxelBits {
  std::array<uint64_t, kBlockSide> words{};

  static constexpr uint64_t bit(size_t place) { return uint64_t{1} << (place % 64); }
  void set(size_t place) { words[place / 64] |= bit(place); }
  void clear(size_t place) { words[place / 64] &= ~bit(place); }
  bool test(size_t place) const { return (words[place / 64] & bit(place)) != 0; }
};

/** A set of voxels. */
class VoxelSetBlocks {
 public:
  using Blocks = std::unordered_map<BlockKey, VoxelBits>;

  VoxelBits& operator[](BlockKey block) { return blocks_[block]; }
  const VoxelBits* find(BlockKey block) const {
    const auto found = blocks_.find(block);
    return found == blocks_.end() ? nullptr : &found->second;
  }
  bool test(const VoxelIndex& voxel) const {
    const VoxelBits* bits = isInGrid(voxel) ? find(blockOf(voxel)) : nullptr;
    return bits && bits->test(placeInBlock(voxel));
  }
  const Blocks& blocks() const { return blocks_; }

 private:
  Blocks blocks_;
};

}  // namespace lamp
