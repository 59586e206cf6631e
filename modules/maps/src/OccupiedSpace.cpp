#include "OccupiedSpace.h"

#include <algorithm>

namespace lamp {

namespace {

void unite(const VoxelSetBlocks& more, VoxelSetBlocks& set) {
  for (const auto& [key, bits] : more.blocks()) {
    VoxelBits& target = set[key];
    for (size_t word = 0; word < bits.words.size(); ++word) target.words[word] |= bits.words[word];
  }
}

/** What was where a robot drove later was only passing: dust, or another robot. */
void removePassing(const DrivenGround& driven, const OccupancyMap& evidence,
                   VoxelSetBlocks& occupied) {
  for (const auto& [key, last] : driven.crossed) {
    const BlockKey block = key / kBlockVoxels;
    const size_t place = key % kBlockVoxels;
    const VoxelBits* ground = driven.ground.find(block);
    if (!occupied.find(block) || (ground && ground->test(place))) continue;
    const auto counts = evidence.counts().blocks().find(block);
    const VoxelCounts voxel =
        counts == evidence.counts().blocks().end() ? VoxelCounts() : counts->second->at(place);
    if (voxel.hit_times <= voxel.hits * evidence.timeOf(last)) occupied[block].clear(place);
  }
}

/** The layers in which the sensors were. */
VoxelLayers sensorLayers(const ComponentMap& map, double resolution_m) {
  VoxelLayers layers;
  for (const MapKeyNode& key_node : map.key_nodes) {
    if (!key_node.scan) continue;
    for (const SensorOrigin& sensor : key_node.scan->sensors) {
      const int z = voxelAt(key_node.world_T_base * sensor.position / resolution_m).z();
      layers.lowest = std::min(layers.lowest, z);
      layers.highest = std::max(layers.highest, z);
    }
  }
  return layers;
}

}  // namespace

OccupiedSpace::OccupiedSpace(const OccupancyMap& evidence, const ComponentMap& map,
                             const OccupancyOptions& options)
    : options_(options), lasers_(sensorLayers(map, options.resolution_m)) {
  VoxelSetBlocks occupied = occupiedVoxels(evidence.counts());
  DrivenGround driven = drivenGround(
      map.tracks, occupied, {options.body_radius_m, options.body_height_m}, options.resolution_m);
  driven_floor_ = std::move(driven.floor);
  if (!options.driven_ground) driven = {};
  unite(driven.ground, occupied);
  removePassing(driven, evidence, occupied);
  states_ = classify(evidence.counts(), occupied, driven.entered);
}

const std::vector<Storey>& OccupiedSpace::storeys() {
  if (storeys_) return *storeys_;
  const VoxelLookup voxels(states_);
  storeys_ = driven_floor_.empty()
                 ? std::vector<Storey>{levelStorey(states_, lasers_)}
                 : storeysOf(findFloor(voxels, driven_floor_, floorLimits(options_)), voxels);
  return *storeys_;
}

}  // namespace lamp
