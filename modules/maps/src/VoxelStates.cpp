#include "VoxelStates.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "VoxelMorphology.h"

namespace lamp {

namespace {

/** Makes a set of voxels block by block, in parallel. */
template <class Make>
VoxelSetBlocks eachBlock(const OccupancyCounts& counts, Make&& make) {
  struct Task {
    BlockKey key;
    const CountsBlock* counts;
    VoxelBits* result;
  };
  VoxelSetBlocks set;
  std::vector<Task> tasks;
  for (const auto& [key, block] : counts.blocks()) tasks.push_back({key, block.get(), &set[key]});
  tbb::parallel_for(size_t{0}, tasks.size(),
                    [&](size_t i) { *tasks[i].result = make(tasks[i].key, *tasks[i].counts); });
  return set;
}

/** The voxels with a property. */
template <class Property>
VoxelBits voxelsWith(const CountsBlock& counts, Property&& property) {
  VoxelBits bits;
  for (size_t i = 0; i < kBlockVoxels; ++i)
    if (property(counts.at(i))) bits.set(i);
  return bits;
}

bool isHit(const VoxelCounts& voxel) {
  return voxel.hits > 0;
}

/** Something was here and went: enough scans would have hit it since, from several places. */
bool isGone(const VoxelCounts& voxel) {
  constexpr int kFewest = 3, kPerHit = 2;
  if (voxel.clear_passes < std::max(kFewest, kPerHit * voxel.hits)) return false;
  // Mean time of the passes against that of the hits.
  return uint64_t{voxel.clear_times} * voxel.hits > uint64_t{voxel.hit_times} * voxel.clear_passes;
}

/** It may have been something that went: at least as many scans would have hit it as did. */
bool isDoubtful(const VoxelCounts& voxel) {
  return isHit(voxel) && voxel.clear_passes >= voxel.hits;
}

/** Those of the 26 neighbours that are in a set. */
std::vector<VoxelIndex> neighborsOf(const VoxelIndex& voxel, const VoxelSetBlocks& set) {
  std::vector<VoxelIndex> neighbors;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const VoxelIndex neighbor = voxel + VoxelIndex(x, y, z);
        if (neighbor != voxel && set.test(neighbor)) neighbors.push_back(neighbor);
      }
  return neighbors;
}

std::vector<VoxelIndex> voxelsOf(const VoxelSetBlocks& set) {
  std::vector<VoxelIndex> voxels;
  for (const auto& [key, bits] : set.blocks())
    for (size_t i = 0; i < kBlockVoxels; ++i)
      if (bits.test(i)) voxels.push_back(firstVoxelOf(key) + fromPlaceInBlock(i));
  return voxels;
}

/** What moved leaves a trail, of which some voxels are seen through often and others seldom: the
 * certain ones, and all doubtful ones that these join (hysteresis, as of Canny's edges, 1986). */
VoxelSetBlocks movedAway(const OccupancyCounts& counts) {
  VoxelSetBlocks gone =
      eachBlock(counts, [](BlockKey, const auto& block) { return voxelsWith(block, isGone); });
  const VoxelSetBlocks doubtful =
      eachBlock(counts, [](BlockKey, const auto& block) { return voxelsWith(block, isDoubtful); });
  std::vector<VoxelIndex> front = voxelsOf(gone);
  while (!front.empty()) {
    const VoxelIndex voxel = front.back();
    front.pop_back();
    for (const VoxelIndex& neighbor : neighborsOf(voxel, doubtful)) {
      if (gone.test(neighbor)) continue;
      gone[blockOf(neighbor)].set(placeInBlock(neighbor));
      front.push_back(neighbor);
    }
  }
  return gone;
}

/** What was hit and did not move away. */
VoxelBits standing(const VoxelSetBlocks& gone, BlockKey key, const CountsBlock& counts) {
  VoxelBits bits = voxelsWith(counts, isHit);
  const VoxelBits& away = *gone.find(key);
  for (size_t word = 0; word < bits.words.size(); ++word) bits.words[word] &= ~away.words[word];
  return bits;
}

/** Adds voxels without a hit that lie in gaps of what was hit: closed by one voxel, unless several
 * scans saw through. */
VoxelBits withGapsClosed(const VoxelSetBlocks& hit, BlockKey block, const CountsBlock& counts) {
  constexpr int kSeenThrough = 2;
  BlockSurroundings closed(hit, block);
  closed.dilate();
  closed.erode();
  VoxelBits bits = closed.center();
  const VoxelBits* kept = hit.find(block);
  for (size_t i = 0; i < kBlockVoxels; ++i)
    if (bits.test(i) && !kept->test(i) && counts.at(i).clear_passes >= kSeenThrough) bits.clear(i);
  return bits;
}

VoxelState limited(int scans) {
  return static_cast<VoxelState>(std::clamp<int>(scans, 1, kSurest));
}

/** A surface that no ray hit may reach into the neighbours of an occupied voxel: rays that pass
 * there are no witness, only the robot's own body is. */
StateBlock stateOf(BlockKey key, const CountsBlock* counts, const VoxelSetBlocks& occupied,
                   const VoxelSetBlocks& entered) {
  StateBlock states{};
  BlockSurroundings surroundings(occupied, key);
  const VoxelBits solid = surroundings.center();
  surroundings.dilate();
  const VoxelBits beside = surroundings.center();
  const VoxelBits* body = entered.find(key);
  for (size_t i = 0; i < kBlockVoxels; ++i) {
    const uint16_t passes = counts ? counts->passes(i) : uint16_t{0};
    if (solid.test(i))
      states[i] = limited(counts ? counts->at(i).hits : uint16_t{0});
    else if (body && body->test(i))
      states[i] = -kSurest;
    else if (passes > 0 && !beside.test(i))
      states[i] = static_cast<VoxelState>(-limited(passes));
  }
  return states;
}

/** Nothing is around, or one other that is as alone. */
bool isSpeck(const VoxelIndex& voxel, const VoxelSetBlocks& hit) {
  const std::vector<VoxelIndex> neighbors = neighborsOf(voxel, hit);
  return neighbors.empty() ||
         (neighbors.size() == 1 && neighborsOf(neighbors.front(), hit).size() == 1);
}

/** Leaves out single returns without others around where several scans saw through: dust, or a
 * fault of the lidar. */
VoxelBits withoutSpecks(const VoxelSetBlocks& hit, BlockKey block, const CountsBlock& counts) {
  VoxelBits bits = *hit.find(block);
  const VoxelIndex first = firstVoxelOf(block);
  constexpr int kSeenThrough = 3;
  for (size_t i = 0; i < kBlockVoxels; ++i)
    if (bits.test(i) && counts.at(i).hits == 1 && counts.passes(i) >= kSeenThrough &&
        isSpeck(first + fromPlaceInBlock(i), hit))
      bits.clear(i);
  return bits;
}

}  // namespace

VoxelSetBlocks occupiedVoxels(const OccupancyCounts& counts) {
  const VoxelSetBlocks gone = movedAway(counts);
  const VoxelSetBlocks hit = eachBlock(
      counts, [&](BlockKey key, const auto& block) { return standing(gone, key, block); });
  const VoxelSetBlocks things = eachBlock(
      counts, [&](BlockKey key, const auto& block) { return withoutSpecks(hit, key, block); });
  return eachBlock(
      counts, [&](BlockKey key, const auto& block) { return withGapsClosed(things, key, block); });
}

VoxelStates classify(const OccupancyCounts& counts, const VoxelSetBlocks& occupied,
                     const VoxelSetBlocks& entered) {
  std::vector<BlockKey> keys;
  for (const auto& [key, block] : counts.blocks()) keys.push_back(key);
  for (const VoxelSetBlocks* set : {&occupied, &entered})
    for (const auto& [key, bits] : set->blocks()) keys.push_back(key);
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());

  VoxelStates states(keys.size());
  tbb::parallel_for(size_t{0}, keys.size(), [&](size_t i) {
    const auto found = counts.blocks().find(keys[i]);
    const auto* block = found == counts.blocks().end() ? nullptr : found->second.get();
    states[i] = {keys[i], stateOf(keys[i], block, occupied, entered)};
  });
  const auto isUnknown = [](const std::pair<BlockKey, StateBlock>& block) {
    return std::all_of(block.second.begin(), block.second.end(),
                       [](VoxelState state) { return state == 0; });
  };
  states.erase(std::remove_if(states.begin(), states.end(), isUnknown), states.end());
  return states;
}

VoxelLookup::VoxelLookup(const VoxelStates& states) {
  blocks_.reserve(states.size());
  for (const auto& [key, block] : states) blocks_[key] = &block;
}

}  // namespace lamp
