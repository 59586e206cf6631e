#pragma once

#include <cmath>

#include "lamp/simulation/FreeSpace.h"

namespace lamp::test {

using namespace simulation;

inline Hollow hollow(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double width_m = 3,
                     double height_m = 3, const WallStyle& style = {}) {
  Hollow hollow;
  hollow.from = from;
  hollow.to = to;
  hollow.width_m = width_m;
  hollow.height_m = height_m;
  hollow.style = style;
  return hollow;
}

/** A hollow whose walls have a closed form: a box with rounded edges, turned and off the origin. */
struct RoundedBox {
  double length = 9, width = 3.2, height = 2.6, corner = 0.5, yaw = 0.6;
  Eigen::Vector3d middle{-3.3, 2.1, -0.7};  ///< of the floor

  Eigen::Vector3d axis() const { return {std::cos(yaw), std::sin(yaw), 0}; }

  Hollow hollow() const {
    Hollow hollow;
    hollow.from = middle - 0.5 * length * axis();
    hollow.to = middle + 0.5 * length * axis();
    hollow.width_m = width;
    hollow.height_m = height;
    hollow.corner_m = corner;
    return hollow;
  }

  /** Distance from the walls, negative within. */
  double distance(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d local = Eigen::AngleAxisd(-yaw, Eigen::Vector3d::UnitZ()) *
                                  (p - middle - Eigen::Vector3d(0, 0, 0.5 * height));
    const Eigen::Vector3d inner = half() - Eigen::Vector3d::Constant(corner);
    const Eigen::Vector3d q = local.cwiseAbs() - inner;
    return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0) - corner;
  }

  double area() const {
    const Eigen::Vector3d flat = 2 * (half() - Eigen::Vector3d::Constant(corner));
    return 2 * (flat.x() * flat.y() + flat.y() * flat.z() + flat.z() * flat.x()) +
           2 * M_PI * corner * flat.sum() + 4 * M_PI * corner * corner;
  }

  double volume() const {
    const Eigen::Vector3d flat = 2 * (half() - Eigen::Vector3d::Constant(corner));
    return flat.prod() +
           2 * corner * (flat.x() * flat.y() + flat.y() * flat.z() + flat.z() * flat.x()) +
           M_PI * corner * corner * flat.sum() + 4.0 / 3.0 * M_PI * std::pow(corner, 3);
  }

 private:
  Eigen::Vector3d half() const { return 0.5 * Eigen::Vector3d(length, width, height); }
};

}  // namespace lamp::test
