#pragma once

#include <unordered_map>
#include <vector>

#include "VoxelStates.h"
#include "lamp/maps/Occupancy.h"

namespace lamp {

/** What a robot can do on the ground, in voxels. */
struct FloorLimits {
  int step = 1;       ///< from one cell to the next
  int body = 4;       ///< height above the ground
  int length = 5;     ///< of the robot: slopes are those under it, and no wider gap is crossed
  double rise = 0.5;  ///< tangent of the steepest slope
};
FloorLimits floorLimits(const OccupancyOptions& options);

/** The ground of one cell. */
struct FloorCell {
  VoxelIndex voxel;      ///< the highest of the ground
  bool seen = false;     ///< else no ground was seen here, and this is the height of that beside
  bool driven = false;   ///< under a robot's body
  int parent = -1;       ///< the cell from which it was found, or none
  bool blocked = false;  ///< something is within the height of a body above
};

/** Ground on which robots could get from where they drove. A column has several cells, at least the
 * height of a body apart, where there are storeys above each other. */
class Floor {
 public:
  explicit Floor(const FloorLimits& limits) : limits_(limits) {}

  const FloorLimits& limits() const { return limits_; }
  const std::vector<FloorCell>& cells() const { return cells_; }
  /** The cell of the column that is less than a body's height from the voxel, or -1. */
  int find(const VoxelIndex& voxel) const;
  /** Calls `visit(cell)` for all cells of a column. */
  template <class Visit>
  void forColumn(int x, int y, Visit&& visit) const {
    const auto found = columns_.find(columnKey(x, y));
    if (found == columns_.end()) return;
    for (const int cell : found->second) visit(cell);
  }

  FloorCell& cell(int index) { return cells_[static_cast<size_t>(index)]; }
  const FloorCell& cell(int index) const { return cells_[static_cast<size_t>(index)]; }
  int add(const FloorCell& cell);

 private:
  FloorLimits limits_;
  std::vector<FloorCell> cells_;
  std::unordered_map<uint64_t, std::vector<int>> columns_;
};

/** Whether something is within the height of a body above a voxel of ground. */
bool isBlocked(const VoxelLookup& voxels, const VoxelIndex& ground, const FloorLimits& limits);

/** Follows the ground from where robots drove over all that they could climb. Ground with something
 * above it is found, but not followed, and gaps in what was seen are crossed.
 * \param driven the voxels of ground under robots' bodies. */
Floor findFloor(const VoxelLookup& voxels, const std::vector<VoxelIndex>& driven,
                const FloorLimits& limits);

}  // namespace lamp
