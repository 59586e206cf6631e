#include "lamp/simulation/KeyedScans.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lamp/core/VoxelSet.h"

namespace lamp::simulation {

namespace {

/** The stamps of the sweeps that a lidar contributes to a keyed scan. */
std::vector<double> sweepStamps(const MissionRobot& robot, const Lidar& lidar, double stamp,
                                const KeyedOptions& options) {
  if (!lidar.rotates()) return {stamp};
  const double period = lidar.pattern().duration();
  std::vector<double> stamps;
  for (int i = static_cast<int>(options.rotation_s / period) - 1; i >= 0; --i)
    if (stamp - i * period >= robot.truth.begin()) stamps.push_back(stamp - i * period);
  return stamps;
}

void append(const LidarSweep& sweep, const Lidar& lidar, const TrajectoryInterpolator& odometry,
            double stamp, Scan& scan) {
  const auto sensor = static_cast<uint8_t>(scan.sensors.size() - 1);
  const std::vector<Eigen::Vector3f> points = deskew(sweep, lidar, odometry, stamp);
  scan.points.insert(scan.points.end(), points.begin(), points.end());
  // Lidars give intensity as a byte.
  for (const LidarReturn& found : sweep.returns)
    scan.intensity.push_back(std::round(255.0f * found.intensity) / 255.0f);
  scan.sensor.resize(scan.points.size(), sensor);
}

/** Where the sensor was in the middle of its sweeps, seen from the base at the key node. */
Eigen::Vector3d originOf(const Lidar& lidar, const std::vector<double>& stamps,
                         const TrajectoryInterpolator& odometry, double stamp) {
  const double middle = 0.5 * (stamps.front() + stamps.back() + lidar.pattern().duration());
  return odometry.at(stamp).inverse() * odometry.at(middle) *
         lidar.baseTSensor(middle).translation();
}

/** Of the points in `among`, the first in each voxel. */
std::vector<size_t> firstOfVoxels(const Scan& scan, const std::vector<size_t>& among,
                                  float leaf_m) {
  VoxelSet taken(1.0);
  std::vector<size_t> kept;
  for (const size_t i : among)
    if (taken.insert((scan.points[i] / leaf_m).cast<double>())) kept.push_back(i);
  return kept;
}

}  // namespace

uint64_t lidarSeed(const MissionRobot& robot, size_t lidar) {
  return mixSeeds({robot.seed, 6, lidar});
}

void markSeen(const LidarSweep& sweep, SeenTriangles& seen) {
  for (const LidarReturn& found : sweep.returns)
    if (found.triangle != LidarReturn::kNoTriangle &&
        !seen[found.triangle].load(std::memory_order_relaxed))
      seen[found.triangle].store(true, std::memory_order_relaxed);
}

Scan thinned(const Scan& scan, size_t max_points) {
  float leaf_m = 0.1f;
  std::vector<size_t> kept(scan.size());
  std::iota(kept.begin(), kept.end(), size_t{0});
  kept = firstOfVoxels(scan, kept, leaf_m);
  while (kept.size() > max_points) {
    // The number falls with the square of the leaf on surfaces, and with its cube at most.
    leaf_m *= 1.02f * std::cbrt(static_cast<float>(kept.size()) / static_cast<float>(max_points));
    kept = firstOfVoxels(scan, kept, leaf_m);
  }
  Scan result;
  result.sensors = scan.sensors;
  for (const size_t i : kept) {
    result.points.push_back(scan.points[i]);
    result.intensity.push_back(scan.intensity[i]);
    result.sensor.push_back(scan.sensor[i]);
  }
  return result;
}

void appendMoving(const LidarSweep& sweep, const Lidar& lidar,
                  const TrajectoryInterpolator& trajectory, double stamp,
                  std::vector<Eigen::Vector3f>& moving) {
  const auto moves = [](const LidarReturn& found) { return found.moves; };
  if (std::none_of(sweep.returns.begin(), sweep.returns.end(), moves)) return;
  const std::vector<Eigen::Vector3f> points = deskew(sweep, lidar, trajectory, stamp);
  for (size_t i = 0; i < points.size(); ++i)
    if (sweep.returns[i].moves) moving.push_back(points[i]);
}

TrueScan keyedScan(const MissionRobot& robot, size_t key_node, const KeyedOptions& options,
                   SeenTriangles& seen) {
  const double stamp = robot.stampOf(key_node);
  const TrajectoryInterpolator odometry = robot.odometry.interpolator();
  TrueScan result;
  Scan& scan = result.scan;
  for (size_t i = 0; i < robot.lidars.size(); ++i) {
    const Lidar& lidar = robot.lidars[i];
    const std::vector<double> stamps = sweepStamps(robot, lidar, stamp, options);
    scan.sensors.push_back({robot.lidar_names[i], originOf(lidar, stamps, odometry, stamp)});
    for (const double begin : stamps) {
      const LidarSweep sweep = lidar.sweep(robot.truth, begin, lidarSeed(robot, i));
      markSeen(sweep, seen);
      append(sweep, lidar, odometry, stamp, scan);
      appendMoving(sweep, lidar, odometry, stamp, result.moving);
    }
  }
  scan = thinned(scan, static_cast<size_t>(options.max_points));
  return result;
}

}  // namespace lamp::simulation
