#pragma once

#include <optional>
#include <vector>

#include "DrivenGround.h"
#include "OccupancyMap.h"
#include "Storeys.h"
#include "VoxelStates.h"
#include "lamp/maps/Occupancy.h"

namespace lamp {

/** What is known of the space of one map. */
class OccupiedSpace {
 public:
  /** \param evidence of the map's scans. */
  OccupiedSpace(const OccupancyMap& evidence, const ComponentMap& map,
                const OccupancyOptions& options);

  const VoxelStates& states() const { return states_; }
  /** Searched when first asked for. */
  const std::vector<Storey>& storeys();

 private:
  const OccupancyOptions options_;
  VoxelStates states_;
  std::vector<VoxelIndex> driven_floor_;
  VoxelLayers lasers_;
  std::optional<std::vector<Storey>> storeys_;
};

}  // namespace lamp
