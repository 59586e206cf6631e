#pragma once

#include "CloudPoints.h"
#include "VoxelStates.h"

namespace lamp {

/** Tells points of what stands from those of what moved away and of dust, as the occupancy does.
 * A point within the occupancy's range is solid if its voxel is occupied; one beyond, of which the
 * occupancy has taken no account, unless its voxel is free. */
class SolidPoints {
 public:
  struct Grid {
    double resolution_m, max_range_m;
  };
  /** \param states of the grid, must outlive this. */
  SolidPoints(const VoxelStates& states, const Grid& grid);

  bool isSolid(const CloudPoint& point, const ComponentMap& map) const;

 private:
  VoxelState stateAt(const VoxelIndex& voxel) const;

  const Grid grid_;
  std::unordered_map<BlockKey, const StateBlock*> blocks_;
};

}  // namespace lamp
