#pragma once

#include <unordered_map>
#include <utility>
#include <vector>

#include "OccupancyCounts.h"

namespace lamp {

/** What a map says of a voxel: how many scans speak for occupied (positive) or free (negative), at
 * most kSurest; 0 is unknown. */
using VoxelState = int8_t;
constexpr VoxelState kSurest = 5;
using StateBlock = std::array<VoxelState, kBlockVoxels>;

/** Blocks with a known voxel, in the order of their keys. */
using VoxelStates = std::vector<std::pair<BlockKey, StateBlock>>;

/** The voxels that are occupied: those that were hit, and the gaps between, but not what was seen
 * through later. */
VoxelSetBlocks occupiedVoxels(const OccupancyCounts& counts);

/** \param occupied of occupiedVoxels(), and what else is known to be.
 *  \param entered voxels that a robot's body was in: free unless occupied. */
VoxelStates classify(const OccupancyCounts& counts, const VoxelSetBlocks& occupied,
                     const VoxelSetBlocks& entered);

/** Looks voxels up. */
class VoxelLookup {
 public:
  /** \param states must outlive this. */
  explicit VoxelLookup(const VoxelStates& states);

  VoxelState at(const VoxelIndex& voxel) const {
    if (!isInGrid(voxel)) return 0;
    const auto found = blocks_.find(blockOf(voxel));
    return found == blocks_.end() ? VoxelState{0} : (*found->second)[placeInBlock(voxel)];
  }
  bool isOccupied(const VoxelIndex& voxel) const { return at(voxel) > 0; }
  bool isFree(const VoxelIndex& voxel) const { return at(voxel) < 0; }

 private:
  std::unordered_map<BlockKey, const StateBlock*> blocks_;
};

}  // namespace lamp
