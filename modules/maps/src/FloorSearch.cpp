#include "FloorSearch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>

namespace lamp {

namespace {

using Eigen::Vector2i;

/** A place of which the search does not know yet what it is. */
struct Candidate {
  VoxelIndex voxel;
  int gap = 0;  ///< cells since the last ground that was seen
  int parent = -1;
};

class Search {
 public:
  Search(const VoxelLookup& voxels, const FloorLimits& limits)
      : voxels_(voxels), floor_(limits), limits_(limits) {
    waiting_.resize(static_cast<size_t>(limits.length) + 1);
  }

  void start(const std::vector<VoxelIndex>& driven) {
    std::vector<int> cells;
    for (const VoxelIndex& voxel : driven) {
      const int known = floor_.find(voxel);
      if (known < 0)
        cells.push_back(floor_.add({voxel, true, true, -1}));
      else if (voxel.z() > floor_.cell(known).voxel.z())
        floor_.cell(known).voxel = voxel;
    }
    for (const int cell : cells) follow(cell, 0);
  }

  /** Ground that was seen comes first, gaps after it, the narrowest first. */
  Floor run() {
    while (const auto candidate = next()) take(*candidate);
    return std::move(floor_);
  }

 private:
  std::optional<Candidate> next() {
    for (auto& queue : waiting_) {
      if (queue.empty()) continue;
      const Candidate candidate = queue.front();
      queue.pop_front();
      return candidate;
    }
    return std::nullopt;
  }

  void take(const Candidate& candidate) {
    const bool seen = candidate.gap == 0;
    int cell = floor_.find(candidate.voxel);
    if (cell >= 0 && (floor_.cell(cell).seen || !seen)) return;
    if (cell >= 0) {
      floor_.cell(cell).voxel = candidate.voxel;
      floor_.cell(cell).seen = true;
      floor_.cell(cell).parent = candidate.parent;
    } else {
      cell = floor_.add({candidate.voxel, seen, false, candidate.parent});
    }
    follow(cell, candidate.gap);
  }

  void follow(int cell, int gap) {
    floor_.cell(cell).blocked = isBlocked(voxels_, floor_.cell(cell).voxel, limits_);
    if (!floor_.cell(cell).blocked) lookAround(cell, gap);
  }

  void lookAround(int cell, int gap) {
    const VoxelIndex from = floor_.cell(cell).voxel;
    for (const Vector2i& way : kAround) {
      const int x = from.x() + way.x(), y = from.y() + way.y();
      const int climb = std::max(limits_.step, rise(gap + 1));
      const auto ground = surface(x, y, from.z() + climb, from.z() - climb);
      if (ground && isClimbable(cell, *ground))
        waiting_[0].push_back({*ground, 0, cell});
      else if (gap < limits_.length)
        waiting_[static_cast<size_t>(gap) + 1].push_back({{x, y, from.z()}, gap + 1, cell});
    }
  }

  /** Voxels that the steepest slope rises over so many cells, rounded as heights are. */
  int rise(double cells) const { return static_cast<int>(std::floor(1 + limits_.rise * cells)); }

  /** The highest occupied voxel of the range, unless it goes on above it. */
  std::optional<VoxelIndex> surface(int x, int y, int top, int bottom) const {
    bool open = !voxels_.isOccupied({x, y, top + 1});
    for (int z = top; z >= bottom; --z) {
      const bool occupied = voxels_.isOccupied({x, y, z});
      if (occupied && open) return VoxelIndex(x, y, z);
      open = !occupied;
    }
    return std::nullopt;
  }

  /** No slope under the robot's length is too steep; one step is allowed on top. */
  bool isClimbable(int cell, const VoxelIndex& ground) const {
    for (int n = 0; cell >= 0 && n < limits_.length; cell = floor_.cell(cell).parent, ++n) {
      const VoxelIndex way = ground - floor_.cell(cell).voxel;
      const double length = way.head<2>().cast<double>().norm();
      if (std::abs(way.z()) > std::max(limits_.step, 1) + limits_.rise * length) return false;
    }
    return true;
  }

  inline static const std::array<Vector2i, 8> kAround = {
      Vector2i{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};

  const VoxelLookup& voxels_;
  Floor floor_;
  const FloorLimits limits_;
  std::vector<std::deque<Candidate>> waiting_;  ///< by their gaps
};

}  // namespace

FloorLimits floorLimits(const OccupancyOptions& options) {
  constexpr double kRounding = 1e-9;  // 0.2 m are one voxel of 0.2 m
  FloorLimits limits;
  limits.step =
      std::max(1, static_cast<int>(options.max_step_m / options.resolution_m + kRounding));
  limits.body = voxelsIn(options.body_height_m, options.resolution_m);
  limits.length = voxelsIn(2 * options.body_radius_m, options.resolution_m);
  limits.rise = std::tan(options.max_slope_deg * M_PI / 180);
  return limits;
}

int Floor::find(const VoxelIndex& voxel) const {
  int found = -1;
  forColumn(voxel.x(), voxel.y(), [&](int index) {
    if (std::abs(cell(index).voxel.z() - voxel.z()) < limits_.body) found = index;
  });
  return found;
}

int Floor::add(const FloorCell& cell) {
  const auto index = static_cast<int>(cells_.size());
  cells_.push_back(cell);
  columns_[columnKey(cell.voxel.x(), cell.voxel.y())].push_back(index);
  return index;
}

bool isBlocked(const VoxelLookup& voxels, const VoxelIndex& ground, const FloorLimits& limits) {
  for (int above = 1; above <= limits.body; ++above)
    if (voxels.isOccupied(ground + VoxelIndex(0, 0, above))) return true;
  return false;
}

Floor findFloor(const VoxelLookup& voxels, const std::vector<VoxelIndex>& driven,
                const FloorLimits& limits) {
  Search search(voxels, limits);
  search.start(driven);
  return search.run();
}

}  // namespace lamp
