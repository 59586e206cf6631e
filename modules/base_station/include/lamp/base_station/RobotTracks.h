#pragma once

#include <map>
#include <vector>

#include "lamp/core/KeyNodePacket.h"
#include "lamp/core/PoseGraph.h"

namespace lamp {

/** What the robots have sent, and the trajectories that follow from it and from the pose graph. */
class RobotTracks {
 public:
  void add(const KeyNodePacket& packet);
  void add(const RobotEnd& end);

  /** Key nodes with their scans, in KeyNodeId order. */
  const std::map<KeyNodeId, KeyNodePacket>& packets() const { return packets_; }

  /** Optimised trajectory of a robot, one pose per lidar scan: scans between key nodes follow
   * odometry, with the correction blended between their neighbours.
   * \param graph that holds the key nodes. */
  std::vector<StampedPose> trajectory(const PoseGraph& graph, RobotId robot) const;
  /** Dead reckoning from the robot's start pose, one pose per lidar scan. */
  std::vector<StampedPose> odometryTrajectory(RobotId robot) const;

 private:
  std::map<KeyNodeId, KeyNodePacket> packets_;
  std::map<RobotId, std::vector<StampedPose>> trailing_scans_;
};

/** Optimised poses of a robot's key nodes. */
std::vector<StampedPose> keyNodeTrajectory(const PoseGraph& graph, RobotId robot);

}  // namespace lamp
