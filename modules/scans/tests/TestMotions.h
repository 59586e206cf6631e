#pragma once

#include <cmath>
#include <vector>

#include "lamp/core/Geometry.h"

namespace lamp::test {

constexpr double kDegree = M_PI / 180.0;

inline std::vector<Eigen::Vector3f> moved(std::vector<Eigen::Vector3f> points, const Pose3& T) {
  const Eigen::Isometry3f Tf = T.cast<float>();
  for (auto& p : points) p = Tf * p;
  return points;
}

inline Vector6d tangent(double x, double y, double z, double rx, double ry, double rz) {
  Vector6d v;
  v << x, y, z, rx, ry, rz;
  return v;
}

}  // namespace lamp::test
