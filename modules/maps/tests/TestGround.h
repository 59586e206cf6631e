#pragma once

#include <functional>
#include <vector>

#include "TestMaps.h"

namespace lamp {

/** A world of level or sloping floors and upright walls, seen by a robot whose lidar is 0.6 m above
 * its base, which stands on the floor. Nothing hides anything: floors and walls are seen within
 * 4 m if they are less than 2 m above or below. */
class GroundWorld {
 public:
  using Height = std::function<double(double x, double y)>;

  void addFloor(double x0, double x1, double y0, double y1, const Height& z) {
    for (double x = x0; x <= x1; x += kSpacing)
      for (double y = y0; y <= y1; y += kSpacing) points_.emplace_back(x, y, z(x, y));
  }
  void addWall(double x0, double y0, double x1, double y1, double bottom, double top) {
    const double length = std::hypot(x1 - x0, y1 - y0);
    for (double way = 0; way <= length; way += kSpacing)
      for (double z = bottom; z <= top; z += kSpacing)
        points_.emplace_back(x0 + way / length * (x1 - x0), y0 + way / length * (y1 - y0), z);
  }

  /** A robot that drives straight from corner to corner, upright, with a key node each metre. */
  void drive(const std::vector<Eigen::Vector3d>& corners, TestMap& test) const {
    MapTrack track;
    double since_key_node = 1;
    for (size_t i = 1; i < corners.size(); ++i) {
      const Eigen::Vector3d leg = corners[i] - corners[i - 1];
      for (double way = 0; way < leg.norm(); way += 0.1, since_key_node += 0.1) {
        const Pose3 pose(Eigen::Translation3d(corners[i - 1] + way / leg.norm() * leg));
        const double stamp = 0.1 * static_cast<double>(track.poses.size());
        track.poses.push_back({stamp, pose});
        if (since_key_node < 1) continue;
        since_key_node = 0;
        test.add(0, pose, scanFrom(pose.translation()));
        test.map.key_nodes.back().stamp = stamp;
      }
    }
    test.map.tracks.push_back(track);
  }

 private:
  static constexpr double kSpacing = 0.07;

  KeyedScanPtr scanFrom(const Eigen::Vector3d& base) const {
    std::vector<Eigen::Vector3f> seen;
    for (const Eigen::Vector3d& point : points_) {
      const Eigen::Vector3d p = point - base;
      if (p.head<2>().norm() < 4 && std::abs(p.z()) < 2) seen.push_back(p.cast<float>());
    }
    return makeScan(seen, {0, 0, 0.6});
  }

  std::vector<Eigen::Vector3d> points_;
};

/** A hall: x from -0.9 to 10.9, y from -2.9 to 2.9, with walls up to 2 m and a floor at 0.05.
 * Planes are in the middle of voxels of 0.2 m. */
inline GroundWorld hall() {
  GroundWorld world;
  world.addFloor(-0.9, 10.9, -2.9, 2.9, [](double, double) { return 0.05; });
  for (const double y : {-2.9, 2.9}) world.addWall(-0.9, y, 10.9, y, 0.05, 2);
  for (const double x : {-0.9, 10.9}) world.addWall(x, -2.9, x, 2.9, 0.05, 2);
  return world;
}

constexpr double kRampSlopeDeg = 15;

/** A hall (x 0..20, y -2..6), a ramp out of it along y = 0 up to the next storey, 3.2 m higher, and
 * a gallery there along y = 4, back over the hall. */
struct TwoStoreys {
  static constexpr double kFoot = 20, kUp = 3.2;
  const double rise = std::tan(kRampSlopeDeg * M_PI / 180), top = kFoot + kUp / rise;
  GroundWorld world;

  TwoStoreys() {
    world.addFloor(0, kFoot, -2, 6, [](double, double) { return 0.05; });
    world.addFloor(kFoot, top, -1, 1, [this](double x, double) { return onRamp(x); });
    world.addFloor(top, top + 4, -1, 5, [](double, double) { return kUp + 0.05; });
    world.addFloor(2, top, 3, 5, [](double, double) { return kUp + 0.05; });
    world.addWall(0, -2, 0, 6, 0.05, 2);
  }
  double onRamp(double x) const { return 0.05 + rise * (x - kFoot); }
  void drive(TestMap& test) const {
    world.drive({{3, 4, 0.05},
                 {3, 0, 0.05},
                 {kFoot, 0, 0.05},
                 {top, 0, kUp + 0.05},
                 {top + 2, 0, kUp + 0.05},
                 {top + 2, 4, kUp + 0.05},
                 {4, 4, kUp + 0.05}},
                test);
  }
};

}  // namespace lamp
