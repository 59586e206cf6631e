#include "lamp/scans/PlanarAlignment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace lamp {

namespace {

constexpr double kReach_m = 40.0;
constexpr double kWorstOfBest = 0.8;  ///< share of the least placement kept, of the best one's
constexpr double kLeastShare = 0.3;
constexpr double kApart_m = 1.0, kApart_rad = 10 * M_PI / 180;
constexpr int kTop = OccupancyPyramid::kLevels - 1;
/** Of the shifts in one block of this level, and one heading, the best one counts. */
constexpr int kBlockLevel = 3;

using Cells = std::vector<Eigen::Vector2i>;

/** A block of shifts at one heading, with a bound of what each of them can reach. */
struct Block {
  int score = 0;
  size_t heading = 0;
  Eigen::Vector2i shift = Eigen::Vector2i::Zero();  ///< the least of the block, cells

  friend bool operator<(const Block& a, const Block& b) {
    if (a.score != b.score) return a.score > b.score;
    if (a.heading != b.heading) return a.heading < b.heading;
    return std::pair(a.shift.x(), a.shift.y()) < std::pair(b.shift.x(), b.shift.y());
  }
};

Cells cellsWithinReach(const std::vector<Eigen::Vector3f>& points) {
  Cells cells;
  for (const Eigen::Vector3f& point : points)
    if (point.head<2>().norm() <= static_cast<float>(kReach_m))
      cells.emplace_back(OccupancyPyramid::cellOf(point.x()), OccupancyPyramid::cellOf(point.y()));
  return cells;
}

/** Of all cells of a pyramid of which some level is occupied. */
Eigen::AlignedBox2i boxOf(const Cells& cells) {
  constexpr int kMargin = 1 << kTop;
  Eigen::AlignedBox2i box;
  for (const Eigen::Vector2i& cell : cells) box.extend(cell);
  if (box.isEmpty()) return box;
  return {box.min() - Eigen::Vector2i::Constant(kMargin), box.max() + Eigen::Vector2i::Constant(1)};
}

Eigen::Vector2i sizeOf(const Eigen::AlignedBox2i& box) {
  return box.sizes() + Eigen::Vector2i::Constant(1);
}

/** One point for each cell, within reach. */
std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector3f>& points) {
  std::set<std::pair<int, int>> seen;
  std::vector<Eigen::Vector2d> result;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector2d p = point.head<2>().cast<double>();
    if (!(p.norm() <= kReach_m)) continue;
    if (seen.insert({OccupancyPyramid::cellOf(p.x()), OccupancyPyramid::cellOf(p.y())}).second)
      result.push_back(p);
  }
  return result;
}

/** The turn that moves a typical far point by a cell. */
double headingStep(const std::vector<Eigen::Vector2d>& points) {
  std::vector<double> ranges;
  for (const Eigen::Vector2d& point : points) ranges.push_back(point.norm());
  const auto far = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() * 3 / 4);
  std::nth_element(ranges.begin(), far, ranges.end());
  constexpr double kLeast = 0.5 * M_PI / 180, kMost = 3 * M_PI / 180;
  return std::clamp(2 * OccupancyPyramid::kCell_m / std::max(*far, 0.1), kLeast, kMost);
}

class Search {
 public:
  Search(const std::vector<Eigen::Vector3f>& source, const OccupancyPyramid& target,
         double radius_m)
      : target_(target), half_(OccupancyPyramid::cellOf(radius_m)) {
    const std::vector<Eigen::Vector2d> points = thinned(source);
    if (points.empty()) return;
    const double step = headingStep(points);
    for (double heading = -M_PI; heading < M_PI; heading += step) {
      headings_.push_back(heading);
      Cells cells;
      const Eigen::Rotation2Dd turn(heading);
      for (const Eigen::Vector2d& point : points) {
        const Eigen::Vector2d p = turn * point;
        cells.emplace_back(OccupancyPyramid::cellOf(p.x()), OccupancyPyramid::cellOf(p.y()));
      }
      cells_.push_back(std::move(cells));
    }
    least_ = static_cast<int>(std::ceil(kLeastShare * static_cast<double>(points.size())));
    point_count_ = points.size();
  }

  /** The best shift of each block that can come near to the best of all, best first. */
  std::vector<Block> blocks() {
    std::vector<Block> roots;
    constexpr int kStride = 1 << kTop;
    for (size_t heading = 0; heading < headings_.size(); ++heading)
      for (int x = -half_; x <= half_; x += kStride)
        for (int y = -half_; y <= half_; y += kStride)
          roots.push_back(bounded(kTop, heading, {x, y}));
    std::sort(roots.begin(), roots.end());
    for (const Block& root : roots) {
      if (root.score < threshold()) break;
      descend(root, kTop);
    }
    std::sort(found_.begin(), found_.end());
    return found_;
  }

  PlanarPlacement placement(const Block& block) const {
    const Eigen::Vector2d shift = OccupancyPyramid::kCell_m * block.shift.cast<double>();
    return {planarPose(shift.x(), shift.y(), headings_[block.heading]),
            static_cast<double>(block.score) / static_cast<double>(point_count_)};
  }

 private:
  int threshold() const {
    return std::max(least_, static_cast<int>(std::ceil(kWorstOfBest * best_)));
  }

  Block bounded(int level, size_t heading, const Eigen::Vector2i& shift) const {
    Block block{0, heading, shift};
    if (shift.maxCoeff() > half_) return block;  // beyond the radius
    for (const Eigen::Vector2i& cell : cells_[heading])
      block.score += target_.occupied(level, cell.x() + shift.x(), cell.y() + shift.y()) ? 1 : 0;
    return block;
  }

  std::vector<Block> children(const Block& block, int level) const {
    const int half = 1 << (level - 1);
    std::vector<Block> result;
    for (const int x : {0, half})
      for (const int y : {0, half})
        result.push_back(bounded(level - 1, block.heading, block.shift + Eigen::Vector2i(x, y)));
    std::sort(result.begin(), result.end());
    return result;
  }

  void descend(const Block& block, int level) {
    if (level == kBlockLevel) {
      Block best;
      best.score = threshold() - 1;
      bestOf(block, level, best);
      if (best.score < threshold()) return;
      best_ = std::max(best_, best.score);
      found_.push_back(best);
      return;
    }
    for (const Block& child : children(block, level))
      if (child.score >= threshold()) descend(child, level - 1);
  }

  void bestOf(const Block& block, int level, Block& best) const {
    if (block.score <= best.score) return;
    if (level == 0) {
      best = block;
      return;
    }
    for (const Block& child : children(block, level)) bestOf(child, level - 1, best);
  }

  const OccupancyPyramid& target_;
  const int half_;  ///< the largest shift, cells
  std::vector<double> headings_;
  std::vector<Cells> cells_;  ///< of the source, by heading
  size_t point_count_ = 0;
  int least_ = 1, best_ = 0;
  std::vector<Block> found_;
};

bool areApart(const Pose3& a, const Pose3& b) {
  const Pose3 between = a.inverse() * b;
  return between.translation().norm() >= kApart_m || rotationAngle(between) >= kApart_rad;
}

}  // namespace

int OccupancyPyramid::cellOf(double coordinate) {
  return static_cast<int>(std::floor(coordinate / kCell_m));
}

OccupancyPyramid::OccupancyPyramid(const std::vector<Eigen::Vector3f>& points) {
  const Cells cells = cellsWithinReach(points);
  const Eigen::AlignedBox2i box = boxOf(cells);
  if (box.isEmpty()) return;
  origin_ = box.min();
  size_ = sizeOf(box);
  const auto place = [&](int column, int row) {
    return static_cast<size_t>(row) * static_cast<size_t>(size_.x()) + static_cast<size_t>(column);
  };
  cells_.assign(place(0, size_.y()), 0);
  for (const Eigen::Vector2i& cell : cells)
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        cells_[place(cell.x() + dx - origin_.x(), cell.y() + dy - origin_.y())] = 1;
  for (int level = 1; level < kLevels; ++level) {
    const int half = 1 << (level - 1);
    const auto isSet = [&](int column, int row) {
      return column < size_.x() && row < size_.y() &&
             (cells_[place(column, row)] >> (level - 1) & 1) != 0;
    };
    for (int row = 0; row < size_.y(); ++row)
      for (int column = 0; column < size_.x(); ++column)
        if (isSet(column, row) || isSet(column + half, row) || isSet(column, row + half) ||
            isSet(column + half, row + half))
          cells_[place(column, row)] |= static_cast<uint8_t>(1 << level);
  }
}

size_t OccupancyPyramid::bytesFor(const std::vector<Eigen::Vector3f>& points) {
  const Eigen::AlignedBox2i box = boxOf(cellsWithinReach(points));
  return box.isEmpty() ? 0 : static_cast<size_t>(sizeOf(box).prod());
}

std::vector<PlanarPlacement> alignInPlane(const std::vector<Eigen::Vector3f>& source,
                                          const OccupancyPyramid& target, double radius_m,
                                          size_t max_placements) {
  Search search(source, target, radius_m);
  std::vector<PlanarPlacement> placements;
  for (const Block& block : search.blocks()) {
    const PlanarPlacement placement = search.placement(block);
    if (placements.size() >= max_placements ||
        (!placements.empty() && placement.share < kWorstOfBest * placements.front().share))
      break;
    if (std::all_of(placements.begin(), placements.end(), [&](const PlanarPlacement& better) {
          return areApart(better.target_T_source, placement.target_T_source);
        }))
      placements.push_back(placement);
  }
  return placements;
}

}  // namespace lamp
