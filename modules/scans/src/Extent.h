#pragma once

#include <Eigen/Core>
#include <vector>

namespace lamp {

/** Where points lie, and how far apart. */
struct Extent {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  double radius_m = 0;  ///< r.m.s. distance from the centroid
};

/** Zero if there are no points. */
Extent extentOf(const std::vector<Eigen::Vector3f>& points);

}  // namespace lamp
