#pragma once

#include "VoxelBlock.h"

namespace lamp {

/** The voxels of a block and of all around it, for operations of mathematical morphology (Serra,
 * "Image Analysis and Mathematical Morphology", 1982). Results hold for the block itself after up
 * to kBlockSide operations. */
class BlockSurroundings {
 public:
  BlockSurroundings(const VoxelSetBlocks& set, BlockKey block);

  /** Adds the 26 neighbours of each voxel. */
  void dilate();
  /** Keeps the voxels whose 26 neighbours are all in. */
  void erode();
  /** The block itself. */
  VoxelBits center() const;

 private:
  static constexpr size_t kSide = 3 * kBlockSide;
  using Row = uint32_t;
  using Layer = std::array<Row, kSide>;

  void take(const VoxelBits& bits, size_t x, size_t y, size_t z);
  template <class Combine>
  void combineNeighbors(Combine combine);

  std::array<Layer, kSide> layers_{};  ///< [z][y], one bit for each x
};

}  // namespace lamp
