#pragma once

#include <string>
#include <vector>

#include "lamp/simulation/SimConfig.h"

namespace lamp::simulation {

/** One robot's part in a mission: where it truly was, and what it knew, but for its lidars. */
struct MissionRobot {
  std::string name;
  uint64_t seed;                  ///< of everything random about this robot
  TrajectoryInterpolator truth;   ///< world_T_base
  SimulatedOdometry odometry;     ///< one pose a lidar scan, and a few more
  size_t scans;                   ///< how many whole scans there are
  std::vector<size_t> key_nodes;  ///< places in odometry.odom_T_base
  std::vector<Lidar> lidars;      ///< in the order of `lidar_names`; the first one leads
  std::vector<std::string> lidar_names;
  std::vector<ImuReading> imu;
  std::vector<RssiReading> rssi;
  std::vector<Sighting> sightings;
  std::vector<double> arrivals;  ///< stamp at which each key node reaches the base

  /** Stamps of the scans. */
  std::vector<double> scanStamps() const;
  double stampOf(size_t key_node) const { return odometry.odom_T_base[key_nodes[key_node]].stamp; }
};

/** A team in a world. */
struct Mission {
  std::vector<MissionRobot> robots;
  std::vector<Beacon> beacons;
  Lidar::Movers movers;  ///< null if there are none
};

/** Drives the team through the world, from one gate. \param world, caster must outlive the mission.
 */
Mission makeMission(const SimConfig& config, const World& world, const RayCaster& caster,
                    uint64_t seed);

/** Places of the poses where a key node is due: moved or turned enough since the last (paper II-B).
 */
std::vector<size_t> selectKeyNodes(const std::vector<StampedPose>& odom_T_base,
                                   const KeyedOptions& options);

}  // namespace lamp::simulation
