#include "NeighborPairs.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lamp {

namespace {

using Eigen::Vector3f;

/** A cell of the grid, as one number that grows with x, then y, then z. */
using CellNumber = uint64_t;
constexpr int kBitsPerAxis = 21;

}  // namespace

std::vector<NeighborPair> neighborPairs(const std::vector<Vector3f>& points, double radius) {
  std::vector<NeighborPair> pairs;
  if (points.empty()) return pairs;
  Vector3f low = points.front();
  for (const Vector3f& p : points) low = low.cwiseMin(p);
  const auto r = static_cast<float>(radius);
  const auto number = [](const Eigen::Matrix<int64_t, 3, 1>& cell) {
    return static_cast<CellNumber>((cell.x() << (2 * kBitsPerAxis)) + (cell.y() << kBitsPerAxis) +
                                   cell.z());
  };
  std::vector<Eigen::Matrix<int64_t, 3, 1>> cells(points.size());
  for (size_t i = 0; i < points.size(); ++i)
    cells[i] = ((points[i] - low) / r).array().floor().cast<int64_t>() + 1;
  std::vector<uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return std::pair(number(cells[a]), a) < std::pair(number(cells[b]), b);
  });
  std::vector<CellNumber> numbers(points.size());
  for (size_t k = 0; k < order.size(); ++k) numbers[k] = number(cells[order[k]]);

  // Three cells in a row along z are one range of the order.
  const auto pairWithRow = [&](uint32_t i, const Eigen::Matrix<int64_t, 3, 1>& middle) {
    const CellNumber row = number(middle);
    auto k = std::lower_bound(numbers.begin(), numbers.end(), row - 1) - numbers.begin();
    for (; k < static_cast<std::ptrdiff_t>(numbers.size()) &&
           numbers[static_cast<size_t>(k)] <= row + 1;
         ++k) {
      const uint32_t j = order[static_cast<size_t>(k)];
      if (j <= i) continue;
      const float squared = (points[j] - points[i]).squaredNorm();
      if (squared <= r * r && squared > 0) pairs.push_back({i, j, squared});
    }
  };
  for (const uint32_t i : order)
    for (int64_t dx = -1; dx <= 1; ++dx)
      for (int64_t dy = -1; dy <= 1; ++dy)
        pairWithRow(i, cells[i] + Eigen::Matrix<int64_t, 3, 1>(dx, dy, 0));
  return pairs;
}

}  // namespace lamp
