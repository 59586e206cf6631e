#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

namespace lamp {

/** A cell of a grid. */
struct GridCell {
  int64_t x, y, z;
  bool operator==(const GridCell& o) const { return x == o.x && y == o.y && z == o.z; }
};

struct GridCellHash {
  size_t operator()(const GridCell& c) const {
    return static_cast<size_t>(c.x) * 73856093 ^ static_cast<size_t>(c.y) * 19349669 ^
           static_cast<size_t>(c.z) * 83492791;
  }
};

/** \param point usable, see isUsable(); \param edge_m of the cells. */
inline GridCell cellOf(const Eigen::Vector3f& point, double edge_m) {
  const Eigen::Matrix<int64_t, 3, 1> cell =
      (point.cast<double>() / edge_m).array().floor().cast<int64_t>();
  return {cell.x(), cell.y(), cell.z()};
}

}  // namespace lamp
