#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "BoxWorld.h"
#include "lamp/core/KeyNodePacket.h"

namespace lamp::test {

/** What a robot recorded, and where it truly was. */
struct Recording {
  std::vector<mrpt::serialization::CSerializable::Ptr> objects;  ///< of a rawlog, in time order
  std::vector<StampedPose> truth;                                ///< world_T_base at each scan
};

/** A robot that drives a route of straight lines at 1 m/s, turns on the spot, and whose odometry
 * drifts: 1 % too long, a heading bias, and noise from the seed. It scans every 0.4 m or 30
 * degrees; ranges have a noise of 1 cm. */
struct SyntheticRobot {
  std::string name;
  std::vector<Eigen::Vector2d> route;
  unsigned seed = 1;
  double start_stamp = 1000;
  double scale_error = 0.01;
  double heading_bias_rad_per_m = 0.002;

  /** 3D lidar (16 x 150 rays, CObservationPointCloud `name/lidar`) at 0.3 m above the base and
   * 6-DoF odometry (CObservationRobotPose `name/odom`), on a robot that sways a little. */
  Recording record3d(const BoxWorld& world) const;
  /** 2D laser (360 rays all around, CObservation2DRangeScan `name/laser`) and CObservationOdometry
   * `name/odom`: the observation format. */
  Recording recordPlanar(const BoxWorld& world) const;
  /** The same as pairs of CActionCollection and CSensoryFrame, with labels as `name/laser` too. */
  Recording recordPlanarPairs(const BoxWorld& world) const;
};

/** Once and a bit around the corridor of BoxWorld::building(), counter-clockwise from (3, 3). */
std::vector<Eigen::Vector2d> ringRoute(const Eigen::Vector2d& origin = Eigen::Vector2d::Zero());
/** Three sides of the corridor, clockwise from (17, 9). */
std::vector<Eigen::Vector2d> oppositeRoute();
/** One side of the corridor: 8 m. */
std::vector<Eigen::Vector2d> shortRoute(const Eigen::Vector2d& origin = Eigen::Vector2d::Zero());

}  // namespace lamp::test
