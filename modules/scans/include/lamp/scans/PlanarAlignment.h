#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lamp/core/Geometry.h"

namespace lamp {

/** Cells of a grid in the x-y plane that hold a point, and which regions of them do: level k says
 * of each cell whether it or one of the 2^k × 2^k cells from it towards larger x and y is occupied.
 * So an alignment bounds how well any of many shifts can do with one look (Olson, "M3RSM:
 * Many-to-many multi-resolution scan matching", ICRA 2015). */
class OccupancyPyramid {
 public:
  static constexpr double kCell_m = 0.1;
  static constexpr int kLevels = 6;

  /** \param points in the frame of their key node, metres; those farther than 40 m from it do not
   * count. A point occupies the cells around its own, too. */
  explicit OccupancyPyramid(const std::vector<Eigen::Vector3f>& points);

  /** Number of the cell that holds a coordinate, metres. */
  static int cellOf(double coordinate);
  bool occupied(int level, int x, int y) const {
    const int64_t column = int64_t{x} - origin_.x(), row = int64_t{y} - origin_.y();
    if (column < 0 || row < 0 || column >= size_.x() || row >= size_.y()) return false;
    return (cells_[static_cast<size_t>(row * size_.x() + column)] >> level & 1) != 0;
  }
  /** Memory that the pyramid of these points takes. */
  static size_t bytesFor(const std::vector<Eigen::Vector3f>& points);

 private:
  Eigen::Vector2i origin_ = Eigen::Vector2i::Zero(), size_ = Eigen::Vector2i::Zero();
  std::vector<uint8_t> cells_;  ///< a bit for each level
};

struct PlanarPlacement {
  Pose3 target_T_source = Pose3::Identity();
  double share = 0;  ///< of the source's cells that lie on the target's
};

/** The placements within a radius that bring the largest share of the source's points onto the
 * target's: branch and bound over headings and shifts, exact to a cell and a step of the heading.
 * Best first, each at least 1 m or 10° from the better ones and with no less than 0.8 of the best
 * one's share. \param source points of a level 2D laser, frame of its key node, metres.
 * \param radius_m how far apart the key nodes may be along x and along y. */
std::vector<PlanarPlacement> alignInPlane(const std::vector<Eigen::Vector3f>& source,
                                          const OccupancyPyramid& target, double radius_m,
                                          size_t max_placements);

}  // namespace lamp
