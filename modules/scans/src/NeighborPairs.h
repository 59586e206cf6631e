#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace lamp {

/** Two points that lie near each other, i < j. */
struct NeighborPair {
  uint32_t i, j;
  float squared_distance;  ///< metres², positive
};

/** All pairs of distinct points within `radius` (metres), found with a grid: where every pair is
 * wanted, that is several times faster than asking a tree for each point. */
std::vector<NeighborPair> neighborPairs(const std::vector<Eigen::Vector3f>& points, double radius);

}  // namespace lamp
