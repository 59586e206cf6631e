#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/core/Ids.h"
#include "lamp/core/KeyedScan.h"

namespace lamp {

struct StampedPose {
  double stamp = 0;  ///< seconds, UTC
  Pose3 pose = Pose3::Identity();
};

/** Motion between consecutive key nodes of one robot. */
struct OdometryEdge {
  Pose3 previous_T_this = Pose3::Identity();
  Matrix6d covariance = Matrix6d::Identity();  ///< tangent space at previous_T_this
};

/** Where the first key node of a robot is believed to stand. */
struct StartPrior {
  Pose3 world_T_base = Pose3::Identity();
  Matrix6d covariance = Matrix6d::Identity();  ///< tangent space at world_T_base
};

/** An object or place that a robot has recognised. */
struct LandmarkSighting {
  double stamp = 0;  ///< seconds, UTC
  std::string name;  ///< the same for all robots
  Eigen::Vector3d base_p_sensor = Eigen::Vector3d::Zero();
  Eigen::Vector3d base_p_landmark = Eigen::Vector3d::Zero();
  double sigma_rad = 0;  ///< of the direction, each way
  double sigma_m = 0;    ///< of the distance
};

/** A measured distance to a radio beacon, which stands somewhere or rides on another robot. */
struct RangeReading {
  double stamp = 0;  ///< seconds, UTC
  int beacon = 0;    ///< its number
  Eigen::Vector3d base_p_antenna = Eigen::Vector3d::Zero();
  double range_m = 0;
  double sigma_m = 0;
};

/** What points up, felt while a robot moved evenly or not at all. */
struct GravityReading {
  double stamp = 0;  ///< seconds, UTC
  Eigen::Vector3d base_up = Eigen::Vector3d::UnitZ();
  double sigma_rad = 0;
};

/** What a robot has measured since its previous key node, beside odometry and lidar: of each
 * landmark the nearest sighting, of each beacon and of gravity the last reading. All is in the
 * frame of the key node, to which odometry has carried it. */
struct KeyNodeExtras {
  std::vector<LandmarkSighting> sightings;
  std::vector<RangeReading> ranges;
  std::optional<GravityReading> gravity;
};

/** What a robot sends to the base station for each key node, and nothing more is needed to map. */
struct KeyNodePacket {
  KeyNodeId id;
  double stamp = 0;                       ///< seconds, UTC: the keyed scan's
  Pose3 odom_T_base = Pose3::Identity();  ///< dead reckoning since the robot's first scan
  std::optional<OdometryEdge> odometry;   ///< none for the first key node
  std::optional<StartPrior> prior;        ///< for the first key node, where it is known
  bool planar = false;                    ///< the robot moves and sees in the plane only
  KeyedScanPtr scan;
  /** `odom_T_base` of the scans between the previous key node and this one, in time order. */
  std::vector<StampedPose> passed_scans;
  KeyNodeExtras extras = {};
};

/** What came after a robot's last key node; closes its stream. */
struct RobotEnd {
  RobotId robot;
  std::vector<StampedPose> passed_scans;
  KeyNodeExtras extras = {};  ///< in the frame of the last key node
};

}  // namespace lamp
