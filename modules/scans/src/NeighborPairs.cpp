#include "NeighborPairs.h"

#include <algorithm>
#include <numeric>

namespace lamp {

namespace {

using Eigen::Vector3f;

/** A cell of the grid, as one number that grows with x, then y, then z. Unsigned: of grids too
 * large for it numbers repeat, which costs time only, since distances are checked. */
using CellNumber = uint64_t;
constexpr CellNumber kStepZ = 1, kStepY = CellNumber{1} << 21, kStepX = CellNumber{1} << 42;

/** The points' places, and their cells' numbers, sorted by those. */
struct Grid {
  std::vector<uint32_t> order;
  std::vector<CellNumber> numbers;
};

std::vector<CellNumber> cellNumbers(const std::vector<Vector3f>& points, double edge) {
  Vector3f low = points.front();
  for (const Vector3f& p : points) low = low.cwiseMin(p);
  std::vector<CellNumber> numbers;
  numbers.reserve(points.size());
  for (const Vector3f& p : points) {
    // From 1, so that neighbours have numbers, too.
    const Eigen::Array<CellNumber, 3, 1> cell =
        ((p.cast<double>() - low.cast<double>()) / edge).array().cast<CellNumber>() + CellNumber{1};
    numbers.push_back(cell.x() * kStepX + cell.y() * kStepY + cell.z() * kStepZ);
  }
  return numbers;
}

Grid sorted(const std::vector<CellNumber>& numbers) {
  Grid grid;
  grid.order.resize(numbers.size());
  std::iota(grid.order.begin(), grid.order.end(), 0u);
  std::sort(grid.order.begin(), grid.order.end(), [&](uint32_t a, uint32_t b) {
    return std::pair(numbers[a], a) < std::pair(numbers[b], b);
  });
  grid.numbers.reserve(numbers.size());
  for (const uint32_t i : grid.order) grid.numbers.push_back(numbers[i]);
  return grid;
}

/** Pairs of point i with later points in three cells in a row along z, which are one range of the
 * order. */
void pairWithRow(const std::vector<Vector3f>& points, const Grid& grid, uint32_t i,
                 CellNumber middle, float squared_radius, std::vector<NeighborPair>& pairs) {
  const auto first = std::lower_bound(grid.numbers.begin(), grid.numbers.end(), middle - kStepZ);
  for (auto k = static_cast<size_t>(first - grid.numbers.begin());
       k < grid.numbers.size() && grid.numbers[k] <= middle + kStepZ; ++k) {
    const uint32_t j = grid.order[k];
    if (j <= i) continue;
    const float squared = (points[j] - points[i]).squaredNorm();
    if (squared <= squared_radius && squared > 0) pairs.push_back({i, j, squared});
  }
}

}  // namespace

std::vector<NeighborPair> neighborPairs(const std::vector<Vector3f>& points, double radius) {
  std::vector<NeighborPair> pairs;
  if (points.empty()) return pairs;
  // A little wider, so that what rounding brings within the radius is in the next cell at most.
  const std::vector<CellNumber> numbers = cellNumbers(points, radius * (1 + 1e-5));
  const Grid grid = sorted(numbers);
  const auto squared_radius = static_cast<float>(radius * radius);
  for (const uint32_t i : grid.order)
    for (const CellNumber x : {numbers[i] - kStepX, numbers[i], numbers[i] + kStepX})
      for (const CellNumber row : {x - kStepY, x, x + kStepY})
        pairWithRow(points, grid, i, row, squared_radius, pairs);
  return pairs;
}

}  // namespace lamp
