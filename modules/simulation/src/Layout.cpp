#include "lamp/simulation/Layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lamp::simulation {

namespace {

constexpr double kSameFloorM = 2.0;

double distanceToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                         const Eigen::Vector3d& b) {
  const Eigen::Vector2d axis = (b - a).head<2>();
  const double squared = axis.squaredNorm();
  const double share =
      squared > 0 ? std::clamp(axis.dot((p - a).head<2>()) / squared, 0.0, 1.0) : 0.0;
  const Eigen::Vector3d nearest = a + share * (b - a);
  if (std::abs(nearest.z() - p.z()) > kSameFloorM) return std::numeric_limits<double>::infinity();
  return (nearest - p).head<2>().norm();
}

}  // namespace

double Passage::length() const {
  double sum = 0;
  for (size_t i = 1; i < floor.size(); ++i) sum += (floor[i] - floor[i - 1]).norm();
  return sum;
}

std::vector<size_t> Layout::passagesAt(size_t place) const {
  std::vector<size_t> found;
  for (size_t i = 0; i < passages.size(); ++i)
    if (passages[i].from == place || passages[i].to == place) found.push_back(i);
  return found;
}

double Layout::distanceToPassages(const Eigen::Vector3d& p) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Passage& passage : passages)
    for (size_t i = 1; i < passage.floor.size(); ++i)
      nearest = std::min(nearest, distanceToSegment(p, passage.floor[i - 1], passage.floor[i]));
  return nearest;
}

}  // namespace lamp::simulation
