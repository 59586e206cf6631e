#pragma once

#include <limits>
#include <vector>

#include "FloorSearch.h"

namespace lamp {

enum class CellState : uint8_t { kUnknown, kFree, kOccupied };

/** One cell of a grid that follows the ground. */
struct StoreyCell {
  VoxelIndex ground;  ///< the highest voxel of the ground
  bool seen = false;  ///< else no ground was seen here, and this is the height of that beside
  CellState state = CellState::kUnknown;  ///< of the height of a robot's body above it
  int clearance = 0;  ///< voxels above the ground that are not occupied; at most kMostClearance
};
constexpr int kMostClearance = 100;

/** The layer in which robots drive: at most one cell a column, by y, then x. */
struct Storey {
  std::vector<StoreyCell> cells;
};

/** A range of voxels' heights; empty at first. */
struct VoxelLayers {
  int lowest = std::numeric_limits<int>::max(), highest = std::numeric_limits<int>::min();
};

/** Divides ground into storeys, so that each driven cell is on one and has its column for itself. A
 * storey is what can be reached from its start without leaving the start's height by more than a
 * limit; where the way between two storeys was driven, its middle is on both. Around the ground
 * there is a margin, for walls to be as thick as they are. The first has the first of the driven
 * cells. */
std::vector<Storey> storeysOf(const Floor& floor, const VoxelLookup& voxels);

/** The storey of robots that see no ground and drive on a level, as those with a 2D laser: what is
 * occupied in any, or else free in any, of the layers of their lasers. */
Storey levelStorey(const VoxelStates& states, const VoxelLayers& layers);

}  // namespace lamp
