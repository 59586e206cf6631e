#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/core/KeyedScan.h"

namespace lamp::test {

/** Points on the walls, floor and ceiling of a box in the world, as seen from a pose in it. */
struct Box {
  Eigen::Vector3d min, max;
  double spacing_m = 0.25;
  double range_m = 12.0;
  double noise_m = 0.01;

  KeyedScanPtr scan(const Pose3& world_T_base, unsigned seed) const {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::normal_distribution<double> noise(0, noise_m);
    auto scan = std::make_shared<Scan>();
    for (int axis = 0; axis < 3; ++axis)
      for (const double level : {min[axis], max[axis]}) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const auto points =
            static_cast<int>((max[u] - min[u]) * (max[v] - min[v]) / (spacing_m * spacing_m));
        for (int i = 0; i < points; ++i) {
          Eigen::Vector3d p;
          p[axis] = level + noise(random);
          p[u] = min[u] + unit(random) * (max[u] - min[u]);
          p[v] = min[v] + unit(random) * (max[v] - min[v]);
          const Eigen::Vector3d seen = world_T_base.inverse() * p;
          if (seen.norm() < range_m) scan->points.push_back(seen.cast<float>());
        }
      }
    scan->sensor.assign(scan->points.size(), 0);
    scan->sensors.push_back({"lidar", Eigen::Vector3d::Zero()});
    return scan;
  }
};

/** A motion by a normally distributed error. */
inline Pose3 disturbed(const Pose3& pose, double sigma_m, double sigma_rad, std::mt19937& random) {
  std::normal_distribution<double> normal(0, 1);
  Vector6d error;
  for (int k = 0; k < 6; ++k) error[k] = normal(random) * (k < 3 ? sigma_m : sigma_rad);
  return pose * expSE3(error);
}

}  // namespace lamp::test
