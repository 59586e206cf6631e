#pragma once

#include <atomic>
#include <map>
#include <vector>

#include "lamp/core/KeyedScan.h"
#include "lamp/simulation/Mission.h"

namespace lamp::simulation {

/** Which triangles of a mesh any scan has hit. */
using SeenTriangles = std::vector<std::atomic<bool>>;

/** Returns from movers by scan, that is by row of the robot's true trajectory. */
using MovingPoints = std::map<size_t, std::vector<Eigen::Vector3f>>;

/** A simulated scan, and what the robot does not know of it. */
struct TrueScan {
  Scan scan;
  std::vector<Eigen::Vector3f> moving;  ///< all returns from movers, as in the scan but not thinned
};

/** What a key node sends (paper II-B): all lidars' sweeps at its stamp, deskewed with odometry,
 * merged, and thinned to one point a voxel; of a rotating mount, the sweeps of the last
 * `rotation_s`. Base frame. Marks what was seen. Safe to call from many threads. */
TrueScan keyedScan(const MissionRobot& robot, size_t key_node, const KeyedOptions& options,
                   SeenTriangles& seen);

/** The first point of each voxel, for the smallest voxels of 0.1 m and more that leave at most
 * `max_points`. */
Scan thinned(const Scan& scan, size_t max_points);

/** The returns from movers, in the base frame at one stamp.
 * \param trajectory that deskews them (see deskew()). */
void appendMoving(const LidarSweep& sweep, const Lidar& lidar,
                  const TrajectoryInterpolator& trajectory, double stamp,
                  std::vector<Eigen::Vector3f>& moving);

/** Marks the surfaces that a sweep hit. */
void markSeen(const LidarSweep& sweep, SeenTriangles& seen);

/** Seed of a lidar of a robot. */
uint64_t lidarSeed(const MissionRobot& robot, size_t lidar);

}  // namespace lamp::simulation
