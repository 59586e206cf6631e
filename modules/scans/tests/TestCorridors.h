#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "lamp/scans/VoxelFilter.h"

namespace lamp {

struct TestLidar {
  int rings, columns;
  double max_range_m, noise_m;
};

/** A straight corridor along x without any detail: 4 x 3 m, or round with a radius of 2.5 m. */
struct SmoothCorridor {
  bool round = false;
  double end_m = std::numeric_limits<double>::infinity();  ///< where a wall closes it

  double range(double x_m, const Eigen::Vector3d& ray) const {
    const auto until = [](double distance, double speed) {
      return speed * distance > 0 ? distance / speed : std::numeric_limits<double>::infinity();
    };
    const double across = round ? 2.5 / std::hypot(ray.y(), ray.z())
                                : std::min({until(2, ray.y()), until(-2, ray.y()),
                                            until(2, ray.z()), until(-1, ray.z())});
    return std::min(across, until(end_m - x_m, ray.x()));
  }
};

/** The same, of rectangular section, with a pillar of 0.5 m on both sides every 3 m. */
struct PillaredCorridor {
  double end_m = std::numeric_limits<double>::infinity();  ///< where a wall closes it

  double range(double x_m, const Eigen::Vector3d& ray) const {
    constexpr double kPeriod_m = 3, kSight_m = 30;
    double range = SmoothCorridor{false, end_m}.range(x_m, ray);
    for (double x = std::floor((x_m - kSight_m) / kPeriod_m) * kPeriod_m; x < x_m + kSight_m;
         x += kPeriod_m)
      for (const double y : {-2.0, 1.5})
        range = std::min(range, ofBox({x - x_m, y, -1}, {x - x_m + 0.5, y + 0.5, 2}, ray));
    return range;
  }

 private:
  /** From the origin, outside the box; infinite if the ray passes. */
  static double ofBox(const Eigen::Array3d& low, const Eigen::Array3d& high,
                      const Eigen::Array3d& ray) {
    const Eigen::Array3d to_low = low / ray, to_high = high / ray;
    const double enter = to_low.min(to_high).maxCoeff(), leave = to_low.max(to_high).minCoeff();
    return enter > 0 && enter < leave ? enter : std::numeric_limits<double>::infinity();
  }
};

/** What a level lidar at x on the corridor's axis sees, in its own frame, thinned as the front end
 * thins scans. */
template <class Corridor = SmoothCorridor>
std::vector<Eigen::Vector3f> scanOf(const Corridor& corridor, const TestLidar& lidar, double x_m,
                                    unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> deviation(0, 1);
  Scan scan;
  for (int ring = 0; ring < lidar.rings; ++ring)
    for (int column = 0; column < lidar.columns; ++column) {
      const double up = (30.0 * ring / (lidar.rings - 1) - 15) * M_PI / 180;
      const double around = 2 * M_PI * column / lidar.columns;
      const Eigen::Vector3d ray(std::cos(around) * std::cos(up), std::sin(around) * std::cos(up),
                                std::sin(up));
      const double range = corridor.range(x_m, ray);
      if (range > lidar.max_range_m) continue;
      scan.points.push_back(((range + lidar.noise_m * deviation(random)) * ray).cast<float>());
    }
  scan.sensor.assign(scan.size(), 0);
  scan.sensors = {{"lidar", Eigen::Vector3d::Zero()}};
  return AdaptiveVoxelFilter({}).filter(scan).points;
}

}  // namespace lamp
