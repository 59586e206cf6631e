#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "ScanRays.h"

namespace lamp {

/** What all scans say of one voxel: whole numbers, so that a scan can be taken out again without a
 * trace. Times are of 16 bits, so that their sums fit. */
struct VoxelCounts {
  uint16_t hits = 0;          ///< scans of which a ray ends here
  uint16_t clear_passes = 0;  ///< scans that would have hit a thing here
  uint32_t hit_times = 0;     ///< sum over the hits
  uint32_t clear_times = 0;   ///< sum over the clear passes
};

/** The counts of one block. Most voxels were only seen through from afar, which takes two bytes;
 * the rest is there for layers in which a voxel has some. */
class CountsBlock {
 public:
  /** Scans of which a ray went through. */
  uint16_t passes(size_t place) const { return passes_[place]; }
  VoxelCounts at(size_t place) const {
    const auto& layer = layers_[place / 64];
    return layer ? (*layer)[place % 64] : VoxelCounts();
  }
  bool isEmpty() const;

  uint16_t& passes(size_t place) { return passes_[place]; }
  VoxelCounts& makeAt(size_t place);

 private:
  using Layer = std::array<VoxelCounts, 64>;
  std::array<uint16_t, kBlockVoxels> passes_{};
  std::array<std::unique_ptr<Layer>, kBlockSide> layers_;
};

/** One scan's part in the counts. */
struct ScanEvidence {
  ScanRays rays;
  uint16_t time = 0;
  bool new_place = true;  ///< not where the robot looked from just before: clear passes count
};

/** The counts of all voxels of which a scan says anything. */
class OccupancyCounts {
 public:
  using Blocks = std::unordered_map<BlockKey, std::unique_ptr<CountsBlock>>;

  /** In parallel over blocks. \throws std::runtime_error if more scans see a voxel than it can
   * count. */
  void add(const std::vector<ScanEvidence>& scans);
  /** Takes out what was added before; blocks of which nothing is left go, too. */
  void subtract(const std::vector<ScanEvidence>& scans);

  void clear() { blocks_.clear(); }
  const Blocks& blocks() const { return blocks_; }

 private:
  Blocks blocks_;
};

}  // namespace lamp
