#include "Extent.h"

#include <cmath>

namespace lamp {

Extent extentOf(const std::vector<Eigen::Vector3f>& points) {
  Extent extent;
  if (points.empty()) return extent;
  const auto count = static_cast<double>(points.size());
  for (const Eigen::Vector3f& point : points) extent.centroid += point.cast<double>();
  extent.centroid /= count;
  double squares = 0;
  for (const Eigen::Vector3f& point : points)
    squares += (point.cast<double>() - extent.centroid).squaredNorm();
  extent.radius_m = std::sqrt(squares / count);
  return extent;
}

}  // namespace lamp
