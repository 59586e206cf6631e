#include "lamp/base_station/RobotTracks.h"

namespace lamp {

namespace {

/** Moves the scans since the previous key node, and the key node's own, to the world. The
 * correction that optimisation made at the two key nodes is blended over the time between them. */
void appendCorrected(const std::vector<StampedPose>& passed, const StampedPose& before,
                     const Pose3& before_world, const StampedPose& after, const Pose3& after_world,
                     std::vector<StampedPose>& trajectory) {
  const Pose3 first = before_world * before.pose.inverse();
  const Pose3 last = after_world * after.pose.inverse();
  for (const StampedPose& scan : passed) {
    const double ratio = (scan.stamp - before.stamp) / (after.stamp - before.stamp);
    trajectory.push_back({scan.stamp, interpolate(first * scan.pose, last * scan.pose, ratio)});
  }
}

void appendMoved(const std::vector<StampedPose>& passed, const Pose3& world_T_odom,
                 std::vector<StampedPose>& trajectory) {
  for (const StampedPose& scan : passed)
    trajectory.push_back({scan.stamp, world_T_odom * scan.pose});
}

}  // namespace

void RobotTracks::add(const KeyNodePacket& packet) {
  packets_[packet.id] = packet;
}

void RobotTracks::add(const RobotEnd& end) {
  trailing_scans_[end.robot] = end.passed_scans;
}

std::vector<StampedPose> RobotTracks::trajectory(const PoseGraph& graph, RobotId robot) const {
  std::vector<StampedPose> result;
  const KeyNodePacket* previous = nullptr;
  Pose3 world_T_odom = Pose3::Identity();
  for (const KeyNodeId id : graph.robotNodes(robot)) {
    const KeyNodePacket& packet = packets_.at(id);
    const Pose3& world_T_base = graph.node(id).world_T_base;
    world_T_odom = world_T_base * packet.odom_T_base.inverse();
    if (previous)
      appendCorrected(packet.passed_scans, {previous->stamp, previous->odom_T_base},
                      graph.node(previous->id).world_T_base, {packet.stamp, packet.odom_T_base},
                      world_T_base, result);
    else
      appendMoved(packet.passed_scans, world_T_odom, result);
    result.push_back({packet.stamp, world_T_base});
    previous = &packet;
  }
  if (const auto trailing = trailing_scans_.find(robot); trailing != trailing_scans_.end())
    appendMoved(trailing->second, world_T_odom, result);
  return result;
}

std::vector<StampedPose> RobotTracks::odometryTrajectory(RobotId robot) const {
  std::vector<StampedPose> result;
  Pose3 world_T_odom = Pose3::Identity();
  for (auto at = packets_.lower_bound({robot, 0}); at != packets_.end() && at->first.robot == robot;
       ++at) {
    const KeyNodePacket& packet = at->second;
    if (packet.prior)
      world_T_odom = packet.prior->world_T_base * packet.odom_T_base.inverse();
    else if (result.empty())
      world_T_odom = packet.odom_T_base.inverse();
    appendMoved(packet.passed_scans, world_T_odom, result);
    result.push_back({packet.stamp, world_T_odom * packet.odom_T_base});
  }
  if (const auto trailing = trailing_scans_.find(robot); trailing != trailing_scans_.end())
    appendMoved(trailing->second, world_T_odom, result);
  return result;
}

std::vector<StampedPose> keyNodeTrajectory(const PoseGraph& graph, RobotId robot) {
  std::vector<StampedPose> trajectory;
  for (const KeyNodeId id : graph.robotNodes(robot))
    trajectory.push_back({graph.node(id).stamp, graph.node(id).world_T_base});
  return trajectory;
}

}  // namespace lamp
