#pragma once

#include <optional>
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

/** What a robot sends to the base station for each key node, and nothing more is needed to map. */
struct KeyframePacket {
  KeyframeId id;
  double stamp = 0;                       ///< seconds, UTC: the keyed scan's
  Pose3 odom_T_base = Pose3::Identity();  ///< dead reckoning since the robot's first scan
  std::optional<OdometryEdge> odometry;   ///< none for the first key node
  std::optional<StartPrior> prior;        ///< for the first key node, where it is known
  bool planar = false;                    ///< the robot moves and sees in the plane only
  KeyedScanPtr scan;
  /** `odom_T_base` of the scans between the previous key node and this one, in time order. */
  std::vector<StampedPose> passed_scans;
};

/** The scans after a robot's last key node; closes its stream. */
struct RobotEnd {
  RobotId robot;
  std::vector<StampedPose> passed_scans;
};

}  // namespace lamp
