#include "VoxelMorphology.h"

namespace lamp {

namespace {

constexpr uint64_t kRowMask = (1 << kBlockSide) - 1;

}  // namespace

BlockSurroundings::BlockSurroundings(const VoxelSetBlocks& set, BlockKey block) {
  const VoxelIndex first = firstVoxelOf(block);
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) {
        const VoxelIndex corner = first + kBlockSide * VoxelIndex(x - 1, y - 1, z - 1);
        if (!isInGrid(corner)) continue;
        if (const VoxelBits* bits = set.find(blockOf(corner)))
          take(*bits, static_cast<size_t>(x) * kBlockSide, static_cast<size_t>(y) * kBlockSide,
               static_cast<size_t>(z) * kBlockSide);
      }
}

void BlockSurroundings::take(const VoxelBits& bits, size_t x, size_t y, size_t z) {
  for (size_t dz = 0; dz < kBlockSide; ++dz)
    for (size_t dy = 0; dy < kBlockSide; ++dy)
      layers_[z + dz][y + dy] |= static_cast<Row>(bits.words[dz] >> (dy * kBlockSide) & kRowMask)
                                 << x;
}

template <class Combine>
void BlockSurroundings::combineNeighbors(Combine combine) {
  for (Layer& layer : layers_)
    for (Row& row : layer) row = combine(row, combine(row << 1, row >> 1));
  for (Layer& layer : layers_) {
    const Layer old = layer;
    for (size_t y = 1; y + 1 < kSide; ++y)
      layer[y] = combine(old[y], combine(old[y - 1], old[y + 1]));
  }
  const auto old = layers_;
  for (size_t z = 1; z + 1 < kSide; ++z)
    for (size_t y = 0; y < kSide; ++y)
      layers_[z][y] = combine(old[z][y], combine(old[z - 1][y], old[z + 1][y]));
}

void BlockSurroundings::dilate() {
  combineNeighbors([](Row a, Row b) { return a | b; });
}

void BlockSurroundings::erode() {
  combineNeighbors([](Row a, Row b) { return a & b; });
}

VoxelBits BlockSurroundings::center() const {
  VoxelBits bits;
  for (size_t z = 0; z < kBlockSide; ++z)
    for (size_t y = 0; y < kBlockSide; ++y)
      bits.words[z] |= (layers_[kBlockSide + z][kBlockSide + y] >> kBlockSide & kRowMask)
                       << (y * kBlockSide);
  return bits;
}

}  // namespace lamp
