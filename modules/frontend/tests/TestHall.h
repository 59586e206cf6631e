#pragma once

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/frontend/OdometrySource.h"

namespace lamp::test {

/** Surfaces of a hall of 44 x 34 x 6 m with columns, as points in its frame; the floor at z = 0. */
inline std::vector<Eigen::Vector3f> hall(unsigned seed, int count = 12000, float noise_m = 0.01f) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::normal_distribution<float> noise(0, noise_m);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) {
    const float u = unit(random), v = unit(random);
    Eigen::Vector3f p;
    if (i % 8 == 0) {
      p = {44 * u - 22, 34 * v - 7, 0};
    } else if (i % 8 < 3) {
      p = {44 * u - 22, i % 2 ? -7.0f : 27.0f, 6 * v};
    } else if (i % 8 < 5) {
      p = {i % 2 ? -22.0f : 22.0f, 34 * u - 7, 6 * v};
    } else {  // columns of a metre
      const int column = static_cast<int>(unit(random) * 12);
      const float angle = 2 * static_cast<float>(M_PI) * u;
      p = {static_cast<float>(column % 4) * 11 - 17 + 0.5f * std::cos(angle),
           static_cast<float>(column / 4) * 13 - 4 + 0.5f * std::sin(angle), 6 * v};
    }
    points.push_back(p + Eigen::Vector3f(noise(random), noise(random), noise(random)));
  }
  return points;
}

/** What a lidar 1 m above the base sees of the hall. */
inline FilteredScan hallSeenFrom(const Pose3& hall_T_base, unsigned seed) {
  FilteredScan scan;
  const Eigen::Isometry3f T = hall_T_base.inverse().cast<float>();
  for (const Eigen::Vector3f& point : hall(seed))
    if ((T * point).norm() < 25) scan.points.push_back(T * point);
  scan.origin = {0, 0, 1};
  return scan;
}

}  // namespace lamp::test
