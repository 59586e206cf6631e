#include "WorldFrame.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "lamp/core/LocalFrame.h"

namespace lamp {

namespace {

/** Places with known world coordinates: the first three of six, or all three. */
Eigen::Vector3d placeOf(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::Vector3d>(numbers.data());
}

void moveBy(const Eigen::Vector3d& shift, std::vector<double>& numbers) {
  if (!numbers.empty()) Eigen::Map<Eigen::Vector3d>(numbers.data()) += shift;
}

bool isIn(const Component& component, KeyNodeId id) {
  return std::binary_search(component.nodes.begin(), component.nodes.end(), id);
}

bool tiesToWorld(const Edge& edge, const PoseGraph& graph) {
  return edge.type == EdgeType::kPrior ||
         (edge.endsAtLandmark() && edge.active() && graph.landmarks()[edge.landmark].known);
}

}  // namespace

Eigen::Vector3d localOrigin(const SlamConfig& config) {
  Eigen::AlignedBox3d places;
  for (const RobotOptions& robot : config.robots)
    if (!robot.start_pose.empty()) places.extend(placeOf(robot.start_pose));
  if (places.isEmpty())
    for (const Eigen::Vector3d& plate : config.gate.positions()) places.extend(plate);
  if (places.isEmpty())
    for (const BeaconOptions& beacon : config.beacons)
      if (!beacon.position.empty()) places.extend(placeOf(beacon.position));
  return places.isEmpty() ? Eigen::Vector3d::Zero() : wholeKilometres(places.center());
}

SlamConfig inLocalFrame(SlamConfig config, const Eigen::Vector3d& world_p_origin) {
  for (RobotOptions& robot : config.robots) moveBy(-world_p_origin, robot.start_pose);
  for (BeaconOptions& beacon : config.beacons) moveBy(-world_p_origin, beacon.position);
  config.gate.moveBy(-world_p_origin);
  return config;
}

Eigen::Vector3d originOf(const Component& component, const PoseGraph& local,
                         const Eigen::Vector3d& world_p_origin) {
  const bool tied = std::any_of(local.edges().begin(), local.edges().end(), [&](const Edge& edge) {
    return tiesToWorld(edge, local) && isIn(component, edge.from);
  });
  return tied ? world_p_origin : Eigen::Vector3d::Zero();
}

PoseGraph inWorldFrame(PoseGraph local, const Eigen::Vector3d& world_p_origin) {
  if (world_p_origin.isZero(0)) return local;
  std::vector<bool> moved;
  for (Landmark& landmark : local.landmarks()) {
    if (landmark.known) landmark.world_p += world_p_origin;
    moved.push_back(landmark.known);
  }
  for (const Component& component : local.components()) {
    const Eigen::Vector3d origin = originOf(component, local, world_p_origin);
    for (const KeyNodeId id : component.nodes) local.node(id).world_T_base.pretranslate(origin);
    for (Edge& edge : local.edges()) {
      if (!isIn(component, edge.from)) continue;
      if (edge.type == EdgeType::kPrior) edge.from_T_to.pretranslate(origin);
      if (!edge.endsAtLandmark() || moved[edge.landmark] || !edge.active()) continue;
      moved[edge.landmark] = true;
      local.landmarks()[edge.landmark].world_p += origin;
    }
  }
  return local;
}

}  // namespace lamp
