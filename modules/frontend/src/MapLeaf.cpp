#include "MapLeaf.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "lamp/core/KdTree.h"
#include "lamp/core/Median.h"

namespace lamp {

namespace {

constexpr float kLeastM = 0.1f, kLeastPlanarM = 0.05f, kMostM = 0.5f;

/** Rings of a lidar are dense along and far from one another, so more than the nearest neighbour
 * counts: so many of them, and so many spacings that the farthest of these lies off. */
constexpr size_t kNeighbors = 6, kPlanarNeighbors = 2;
constexpr float kSpacings = 2.2f, kPlanarSpacings = 1.0f;

}  // namespace

float leafFor(const FilteredScan& scan) {
  const size_t neighbors = scan.planar ? kPlanarNeighbors : kNeighbors;
  const float spacings = scan.planar ? kPlanarSpacings : kSpacings;
  const KdTree tree(scan.points);
  std::vector<float> distances;
  std::vector<uint32_t> nearest;
  for (const Eigen::Vector3f& point : scan.points) {
    tree.nearest(point, neighbors + 1, nearest);
    if (nearest.size() == neighbors + 1)
      distances.push_back((scan.points[nearest.back()] - point).norm() / spacings);
  }
  if (distances.empty()) return kMostM;
  return std::clamp(medianOf(std::move(distances)), scan.planar ? kLeastPlanarM : kLeastM, kMostM);
}

}  // namespace lamp
