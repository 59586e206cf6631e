#include "lamp/base_station/ExtraEdges.h"

#include <algorithm>

#include "lamp/core/MeasurementEdges.h"
#include "lamp/core/Trajectory.h"

namespace lamp {

namespace {

using Packets = std::map<KeyNodeId, KeyNodePacket>;

Eigen::Vector3d pointFrom(const std::vector<double>& values) {
  return values.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(values.data());
}

/** Dead reckoning of a robot from its previous key node to this one. */
TrajectoryInterpolator odometryBefore(const KeyNodePacket& packet, const Packets& packets) {
  std::vector<StampedPose> path;
  if (packet.id.index > 0) {
    const KeyNodePacket& previous = packets.at({packet.id.robot, packet.id.index - 1});
    path.push_back({previous.stamp, previous.odom_T_base});
  }
  path.insert(path.end(), packet.passed_scans.begin(), packet.passed_scans.end());
  path.push_back({packet.stamp, packet.odom_T_base});
  return TrajectoryInterpolator(std::move(path));
}

LandmarkIndex findOrAdd(PoseGraph& graph, const Landmark& landmark) {
  if (const auto found = graph.findLandmark(landmark.name)) return *found;
  return graph.addLandmark(landmark);
}

}  // namespace

ExtraEdges::ExtraEdges(const std::vector<RobotOptions>& robots,
                       const std::vector<BeaconOptions>& beacons) {
  for (size_t i = 0; i < robots.size(); ++i)
    if (robots[i].beacon_id >= 0)
      carriers_[robots[i].beacon_id] = {RobotId{static_cast<uint16_t>(i)},
                                        pointFrom(robots[i].beacon_position)};
  for (const BeaconOptions& beacon : beacons) {
    const bool known = !beacon.position.empty();
    beacons_[beacon.id] = {beacon.name, pointFrom(beacon.position), known, known};
  }
}

bool ExtraEdges::add(KeyNodeId id, const KeyNodeExtras& extras, const Packets& packets,
                     PoseGraph& graph) {
  const size_t before = graph.edges().size();
  if (extras.gravity)
    graph.addEdge(gravityEdge(id, extras.gravity->base_up, extras.gravity->sigma_rad));
  for (const LandmarkSighting& seen : extras.sightings)
    graph.addEdge(bearingRangeEdge(id, findOrAdd(graph, {seen.name}), seen.base_p_sensor,
                                   seen.base_p_landmark, seen.sigma_rad, seen.sigma_m));
  for (const RangeReading& range : extras.ranges) {
    const auto carrier = carriers_.find(range.beacon);
    if (carrier == carriers_.end())
      graph.addEdge(rangeEdge(id, beacon(range.beacon, graph), range.base_p_antenna, range.range_m,
                              range.sigma_m));
    else if (carrier->second.robot != id.robot)
      open_.push_back({id, range});
  }
  const auto closed = [&](const OpenRange& range) { return close(range, packets, graph); };
  open_.erase(std::remove_if(open_.begin(), open_.end(), closed), open_.end());
  return graph.edges().size() > before;
}

/** Adds the edge if the other robot's key node at or after the reading is there. */
bool ExtraEdges::close(const OpenRange& range, const Packets& packets, PoseGraph& graph) const {
  const Carrier& carrier = carriers_.at(range.reading.beacon);
  const std::vector<KeyNodeId>& nodes = graph.robotNodes(carrier.robot);
  const auto next =
      std::lower_bound(nodes.begin(), nodes.end(), range.reading.stamp,
                       [&](KeyNodeId id, double stamp) { return graph.node(id).stamp < stamp; });
  if (next == nodes.end()) return false;
  const KeyNodePacket& packet = packets.at(*next);
  const Pose3 odom_T_then = odometryBefore(packet, packets).at(range.reading.stamp);
  const Eigen::Vector3d to_p_beacon =
      packet.odom_T_base.inverse() * (odom_T_then * carrier.base_p_beacon);
  graph.addEdge(robotRangeEdge(range.from, range.reading.base_p_antenna, *next, to_p_beacon,
                               range.reading.range_m, range.reading.sigma_m));
  return true;
}

LandmarkIndex ExtraEdges::beacon(int id, PoseGraph& graph) const {
  const auto found = beacons_.find(id);
  return findOrAdd(
      graph, found == beacons_.end() ? Landmark{"beacon_" + std::to_string(id)} : found->second);
}

}  // namespace lamp
