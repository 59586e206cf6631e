#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace lamp::octahedral {

/** Directions by cells: an octahedron's faces, unfolded to a square. The upper half is the square's
 * inner diamond, the lower half is folded out to the corners. */

/** Cells along an edge of the square: about 2 degrees each, which a keyed scan of some thousand
 * points fills with a point each. */
constexpr int kEdge = 96;
constexpr size_t kCells = size_t{kEdge} * kEdge;

inline int cellAlong(float value) {
  return std::clamp(static_cast<int>((value + 1.0f) * (0.5f * kEdge)), 0, kEdge - 1);
}

/** \param direction of any length but zero, finite. */
inline size_t cellOf(const Eigen::Vector3f& direction) {
  const float sum = direction.cwiseAbs().sum();
  float u = direction.x() / sum, v = direction.y() / sum;
  if (direction.z() < 0) {
    const float folded = (1.0f - std::abs(v)) * (u < 0 ? -1.0f : 1.0f);
    v = (1.0f - std::abs(u)) * (v < 0 ? -1.0f : 1.0f);
    u = folded;
  }
  return static_cast<size_t>(kEdge * cellAlong(v) + cellAlong(u));
}

/** The cells around one, itself included. Each border of the square is folded on itself: beyond it
 * the image goes on at the mirrored place. */
inline std::array<size_t, 9> neighborhood(size_t cell) {
  const int x = static_cast<int>(cell) % kEdge, y = static_cast<int>(cell) / kEdge;
  std::array<size_t, 9> cells;
  size_t k = 0;
  for (int j = y - 1; j <= y + 1; ++j)
    for (int i = x - 1; i <= x + 1; ++i) {
      const bool beyond_x = i < 0 || i >= kEdge, beyond_y = j < 0 || j >= kEdge;
      const int row = beyond_x ? kEdge - 1 - j : j, column = beyond_y ? kEdge - 1 - i : i;
      cells[k++] = static_cast<size_t>(kEdge * std::clamp(row, 0, kEdge - 1) +
                                       std::clamp(column, 0, kEdge - 1));
    }
  return cells;
}

}  // namespace lamp::octahedral
