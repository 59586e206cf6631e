#pragma once

#include "CloudPoints.h"
#include "VoxelStates.h"

namespace lamp {

/** Tells points of what stands from those of what moved away and of dust, as the occupancy does.
 * A point within the occupancy's range is solid if its voxel is occupied; one beyond, of which the
 * occupancy has taken no account, unless its voxel is free. */
class SolidPoints {
 public:
  /** \param states of the occupancy with these options, must outlive this. */
  SolidPoints(const VoxelStates& states, const OccupancyOptions& occupancy);

  bool isSolid(const CloudPoint& point, const ComponentMap& map) const;

 private:
  const OccupancyOptions occupancy_;
  const VoxelLookup voxels_;
};

}  // namespace lamp
