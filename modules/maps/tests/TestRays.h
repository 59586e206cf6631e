#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "TestMaps.h"

namespace lamp {

/** A world of boxes and upright poles, seen by a lidar of 16 lasers. */
struct RayWorld {
  using Vector3d = Eigen::Vector3d;
  struct Pole {
    double x, y, radius;
  };
  std::vector<Eigen::AlignedBox3d> boxes;
  std::vector<Pole> poles;

  void addBox(const Vector3d& min, const Vector3d& max) { boxes.emplace_back(min, max); }

  /** Way to the first surface; infinite if there is none. */
  double range(const Vector3d& from, const Vector3d& direction) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& box : boxes) nearest = std::min(nearest, rangeTo(box, from, direction));
    for (const Pole& pole : poles) nearest = std::min(nearest, rangeTo(pole, from, direction));
    return nearest;
  }

  /** One sweep; the base stands at the place, with the axes of the world, and is the sensor. */
  std::shared_ptr<Scan> scan(const Vector3d& from, double azimuth_step_deg = 1.0) const {
    constexpr double kDegree = M_PI / 180;
    std::vector<Eigen::Vector3f> points;
    for (int laser = 0; laser < 16; ++laser)
      for (double azimuth = 0; azimuth < 360; azimuth += azimuth_step_deg) {
        const double a = azimuth * kDegree, e = (2 * laser - 15) * kDegree;
        const Vector3d direction(std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e));
        const double way = range(from, direction);
        if (way < 60) points.push_back((way * direction).cast<float>());
      }
    return makeScan(points);
  }

  /** Adds what a robot sees at the place to a map. */
  void look(const Vector3d& from, TestMap& test) const {
    test.add(0, Pose3(Eigen::Translation3d(from)), scan(from));
  }

 private:
  static double rangeTo(const Eigen::AlignedBox3d& box, const Vector3d& from, const Vector3d& d) {
    double enter = 0, leave = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      double in = (box.min()[axis] - from[axis]) / d[axis],
             out = (box.max()[axis] - from[axis]) / d[axis];
      if (in > out) std::swap(in, out);
      enter = std::max(enter, in);
      leave = std::min(leave, out);
    }
    return enter < leave && enter > 0 ? enter : std::numeric_limits<double>::infinity();
  }
  static double rangeTo(const Pole& pole, const Vector3d& from, const Vector3d& d) {
    const Eigen::Vector2d to_axis(pole.x - from.x(), pole.y - from.y());
    const double a = d.head<2>().squaredNorm(), b = to_axis.dot(d.head<2>()),
                 root = b * b - a * (to_axis.squaredNorm() - pole.radius * pole.radius);
    return root > 0 && b > 0 ? (b - std::sqrt(root)) / a : std::numeric_limits<double>::infinity();
  }
};

}  // namespace lamp
