#include "lamp/maps/OctoMap.h"

#include "DrivenGround.h"
#include "MapPoints.h"
#include "OccupancyMap.h"
#include "OctreeFile.h"
#include "VoxelStates.h"
#include "lamp/core/CloudHeader.h"
#include "lamp/core/Files.h"

IMPLEMENTS_MRPT_OBJECT(OctoMap, lamp::MapExporter, lamp)

namespace lamp {

namespace {

void unite(const VoxelSetBlocks& more, VoxelSetBlocks& set) {
  for (const auto& [key, bits] : more.blocks()) {
    VoxelBits& target = set[key];
    for (size_t word = 0; word < bits.words.size(); ++word) target.words[word] |= bits.words[word];
  }
}

VoxelStates statesOf(const OccupancyCounts& counts, const ComponentMap& map,
                     const OctoMapOptions& options) {
  VoxelSetBlocks occupied = occupiedVoxels(counts);
  DrivenGround driven;
  if (options.driven_ground)
    driven = drivenGround(map.tracks, occupied, {options.body_radius_m, options.body_height_m},
                          options.resolution_m);
  unite(driven.ground, occupied);
  return classify(counts, occupied, driven.entered);
}

}  // namespace

std::vector<std::string> OctoMap::exportMap(const ComponentMap& map, const std::string& stem) {
  checkMap(map);
  if (!occupancy_)
    occupancy_ = std::make_shared<OccupancyMap>(
        OccupancyMap::Options{options_.resolution_m, options_.max_range_m, options_.tolerance_m});
  occupancy_->update(map);
  if (occupancy_->raysOutOfBounds() > 0)
    MRPT_LOG_WARN_FMT(
        "%zu rays end beyond the range of an octree with voxels of %g m and are left out",
        occupancy_->raysOutOfBounds(), options_.resolution_m);

  const VoxelStates states = statesOf(occupancy_->counts(), map, options_);
  const std::string log_odds = stem + ".ot", binary = stem + ".bt",
                    offset = offsetComment(map.world_p_origin);
  writeBinaryFile(log_odds, [&](std::ostream& file) {
    writeLogOdds(states, options_.resolution_m, offset, file);
  });
  writeBinaryFile(binary, [&](std::ostream& file) {
    writeBonsai(states, options_.resolution_m, offset, file);
  });
  return {log_odds, binary};
}

}  // namespace lamp
