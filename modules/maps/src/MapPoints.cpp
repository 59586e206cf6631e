#include "MapPoints.h"

#include <algorithm>
#include <stdexcept>

namespace lamp {

std::string robotName(const ComponentMap& map, RobotId robot) {
  return map.robots && robot.value < map.robots->size() ? map.robots->name(robot)
                                                        : "robot " + std::to_string(robot.value);
}

namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& fault) {
  throw std::runtime_error("no map is written: " + what + " " + fault +
                           "; check the stage that made it");
}

}  // namespace

void checkScan(const Scan& scan, const std::string& owner) {
  const size_t n = scan.size();
  if (scan.sensor.size() != n || (scan.hasIntensity() && scan.intensity.size() != n))
    refuse(owner, "has a keyed scan whose fields differ in length");
  const auto unknown = [&](uint8_t sensor) { return sensor >= scan.sensors.size(); };
  if (std::any_of(scan.sensor.begin(), scan.sensor.end(), unknown))
    refuse(owner, "has points of a sensor that its keyed scan does not list");
  for (const SensorOrigin& sensor : scan.sensors)
    if (!sensor.position.allFinite())
      refuse(owner, "has a sensor '" + sensor.label + "' whose position is not finite");
}

void checkMap(const ComponentMap& map) {
  for (const MapKeyNode& key_node : map.key_nodes) {
    const std::string owner =
        "key node " + robotName(map, key_node.id.robot) + ":" + std::to_string(key_node.id.index);
    if (!isFinite(key_node.world_T_base)) refuse(owner, "has a pose that is not finite");
    if (key_node.scan) checkScan(*key_node.scan, owner);
  }
  for (const MapTrack& track : map.tracks)
    for (const StampedPose& pose : track.poses)
      if (!isFinite(pose.pose))
        refuse("the trajectory of " + robotName(map, track.robot), "has a pose that is not finite");
  for (const MapLoop& loop : map.loops)
    if (!loop.from.allFinite() || !loop.to.allFinite())
      refuse("a loop closure", "has an end that is not finite");
}

}  // namespace lamp
