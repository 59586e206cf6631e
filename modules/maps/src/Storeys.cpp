#include "Storeys.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <unordered_map>

namespace lamp {

namespace {

/** Where a storey has another above it, it ends at this share of the way there: the way between is
 * on both, and unevenness of the upper one is not on the lower. */
constexpr double kShareOfWayUp = 0.75;

/** Cells under a robot. */
int areaOfRobot(const Floor& floor) {
  return floor.limits().length * floor.limits().length;
}

/** The cells that can be reached from one without leaving its height by more than a limit. */
class Reach {
 public:
  Reach(const Floor& floor, int start) : floor_(floor), start_(start) {
    limit_ = std::numeric_limits<int>::max();
    if (const int met = flood(); met < limit_) {
      limit_ = static_cast<int>(kShareOfWayUp * met);
      flood();
    }
  }

  const std::vector<int>& cells() const { return cells_; }

 private:
  /** Visits cells by how far the way to them leaves the start's height.
   * \return how far that was when the flood came over or under itself where robots drove, by more
   * than the area of a robot: what dust or a heap looks like is smaller. */
  int flood() {
    cells_.clear();
    last_.clear();
    columns_ = Floor(floor_.limits());
    visited_.assign(floor_.cells().size(), false);
    waiting_.clear();
    offer(start_, 0);
    int met = 0;
    for (size_t height = 0; height < waiting_.size(); ++height)
      while (!waiting_[height].empty()) {
        const int cell = waiting_[height].front();
        waiting_[height].pop_front();
        const Meeting meeting = take(cell);
        if (meeting == Meeting::kNone) spread(cell, height);
        if (meeting == Meeting::kDriven && ++met >= areaOfRobot(floor_))
          return static_cast<int>(height);
      }
    for (const int cell : last_)
      if (isColumnFree(floor_.cell(cell))) keep(cell);
    return std::numeric_limits<int>::max();
  }

  enum class Meeting { kNone, kOther, kDriven };

  /** Keeps the cell, unless its column is taken. Cells where robots were come before others, and
   * those where none can be come last. */
  Meeting take(int index) {
    const FloorCell& cell = floor_.cell(index);
    if (!cell.driven && (!cell.seen || cell.blocked)) {
      last_.push_back(index);
      return Meeting::kNone;
    }
    Meeting meeting = Meeting::kNone;
    bool is_taken = false;
    columns_.forColumn(cell.voxel.x(), cell.voxel.y(), [&](int other) {
      is_taken = true;
      FloorCell& there = columns_.cell(other);
      const bool passable = !cell.blocked && !there.blocked;
      if (passable && (cell.driven || there.driven))
        meeting = Meeting::kDriven;
      else if (!cell.driven || there.driven)
        meeting = Meeting::kOther;
      if (!cell.driven || there.driven) return;
      there = cell;
      cells_[static_cast<size_t>(other)] = index;
    });
    if (!is_taken) keep(index);
    return meeting;
  }

  bool isColumnFree(const FloorCell& cell) const {
    bool is_free = true;
    columns_.forColumn(cell.voxel.x(), cell.voxel.y(), [&](int) { is_free = false; });
    return is_free;
  }

  void keep(int index) {
    columns_.add(floor_.cell(index));
    cells_.push_back(index);
  }

  void spread(int index, size_t height) {
    const FloorCell& cell = floor_.cell(index);
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        floor_.forColumn(cell.voxel.x() + dx, cell.voxel.y() + dy, [&](int other) {
          const int climb = std::abs(floor_.cell(other).voxel.z() - cell.voxel.z());
          if (climb < floor_.limits().body || cell.parent == other ||
              floor_.cell(other).parent == index)
            offer(other, height);
        });
  }

  void offer(int index, size_t height_so_far) {
    const int away = std::abs(floor_.cell(index).voxel.z() - floor_.cell(start_).voxel.z());
    if (visited_[static_cast<size_t>(index)] || away > limit_) return;
    visited_[static_cast<size_t>(index)] = true;
    const size_t height = std::max(height_so_far, static_cast<size_t>(away));
    if (waiting_.size() <= height) waiting_.resize(height + 1);
    waiting_[height].push_back(index);
  }

  const Floor& floor_;
  const int start_;
  int limit_;
  std::vector<int> cells_, last_;
  Floor columns_{FloorLimits()};
  std::vector<bool> visited_;
  std::vector<std::deque<int>> waiting_;  ///< by height
};

bool isBefore(const StoreyCell& a, const StoreyCell& b) {
  return a.ground.y() != b.ground.y() ? a.ground.y() < b.ground.y() : a.ground.x() < b.ground.x();
}

/** A storey while it is made: at most one cell a column. */
class StoreyDraft {
 public:
  explicit StoreyDraft(const FloorLimits& limits) : columns_(limits) {}

  void add(const FloorCell& cell) { columns_.add(cell); }

  /** Adds cells of which nothing is known but the height of the nearest that is there. */
  void addMargin() {
    std::vector<FloorCell> edge = columns_.cells();
    for (int ring = 0; ring < columns_.limits().length; ++ring) {
      const size_t begin = columns_.cells().size();
      for (const FloorCell& cell : edge) addAround(cell.voxel);
      edge.assign(columns_.cells().begin() + static_cast<std::ptrdiff_t>(begin),
                  columns_.cells().end());
    }
  }

  Storey finished(const VoxelLookup& voxels) const {
    Storey storey;
    for (const FloorCell& cell : columns_.cells()) {
      StoreyCell made{cell.voxel, cell.seen, stateAbove(cell, voxels), 0};
      while (made.clearance < kMostClearance &&
             !voxels.isOccupied(made.ground + VoxelIndex(0, 0, made.clearance + 1)))
        ++made.clearance;
      if (made.seen || made.state != CellState::kUnknown) storey.cells.push_back(made);
    }
    std::sort(storey.cells.begin(), storey.cells.end(), isBefore);
    return storey;
  }

 private:
  void addAround(const VoxelIndex& voxel) {
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        bool is_there = false;
        columns_.forColumn(voxel.x() + dx, voxel.y() + dy, [&](int) { is_there = true; });
        if (!is_there) columns_.add({voxel + VoxelIndex(dx, dy, 0), false, false, -1});
      }
  }

  /** Nothing is known of what is right above ground, nor of what is beside ground that rises. */
  CellState stateAbove(const FloorCell& cell, const VoxelLookup& voxels) const {
    const FloorLimits& limits = columns_.limits();
    if (isBlocked(voxels, cell.voxel, limits)) return CellState::kOccupied;
    if (!cell.seen) return CellState::kUnknown;
    for (int above = std::min(limits.step + 2, limits.body); above <= limits.body; ++above)
      if (!voxels.isFree(cell.voxel + VoxelIndex(0, 0, above))) return CellState::kUnknown;
    return CellState::kFree;
  }

  Floor columns_;
};

}  // namespace

std::vector<Storey> storeysOf(const Floor& floor, const VoxelLookup& voxels) {
  std::vector<Storey> storeys;
  std::vector<bool> covered(floor.cells().size(), false);
  for (size_t start = 0; start < covered.size(); ++start) {
    if (covered[start] || !floor.cells()[start].driven) continue;
    const Reach reach(floor, static_cast<int>(start));
    StoreyDraft draft(floor.limits());
    int newly_driven = 0;
    for (const int cell : reach.cells()) {
      newly_driven += floor.cell(cell).driven && !covered[static_cast<size_t>(cell)];
      covered[static_cast<size_t>(cell)] = true;
      draft.add(floor.cell(cell));
    }
    if (newly_driven < areaOfRobot(floor) && !storeys.empty()) continue;
    draft.addMargin();
    storeys.push_back(draft.finished(voxels));
  }
  return storeys;
}

Storey levelStorey(const VoxelStates& states, const VoxelLayers& layers) {
  Storey storey;
  for (const auto& [key, block] : states) {
    const VoxelIndex first = firstVoxelOf(key);
    for (size_t i = 0; i < kBlockVoxels; ++i) {
      const VoxelIndex voxel = first + fromPlaceInBlock(i);
      if (block[i] == 0 || voxel.z() < layers.lowest || voxel.z() > layers.highest) continue;
      storey.cells.push_back({{voxel.x(), voxel.y(), layers.lowest - 1},
                              false,
                              block[i] > 0 ? CellState::kOccupied : CellState::kFree,
                              0});
    }
  }
  // Of a column's cells the one that says most stays.
  std::sort(storey.cells.begin(), storey.cells.end(), [](const StoreyCell& a, const StoreyCell& b) {
    return isBefore(a, b) || (!isBefore(b, a) && a.state > b.state);
  });
  const auto same_column = [](const StoreyCell& a, const StoreyCell& b) {
    return a.ground.head<2>() == b.ground.head<2>();
  };
  storey.cells.erase(std::unique(storey.cells.begin(), storey.cells.end(), same_column),
                     storey.cells.end());
  return storey;
}

}  // namespace lamp
