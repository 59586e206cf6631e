#pragma once

#include <tbb/parallel_for.h>

#include "lamp/simulation/KeyedScans.h"

namespace lamp::test {

using namespace simulation;

inline SimConfig configOf(const std::string& kind, const std::string& ini_text) {
  Faults faults;
  const Ini ini = Ini::fromText(ini_text, "test.ini", faults);
  return SimConfig(worldKind(kind), ini, std::move(faults));
}

/** Two robots in the demo world, the second with two lidars of which one is on a rotating mount,
 * and their scans at all key nodes. Made once: many tests look at it. */
struct SmallMission {
  SimConfig config = configOf("demo", R"(
[world]
start_interval_s = 5
[keyed]
max_points = 1500
rotation_s = 0.5
[robot.alpha]
length_m = 70
[robot.bravo]
length_m = 60
lidars = top, hovermap
[lidar.top]
azimuth_steps = 450
[lidar.hovermap]
azimuth_steps = 300
)");
  World world = config.kind->make(150, 0.25, 3);
  RayCaster caster{world.mesh};
  Mission mission = makeMission(config, world, caster, 10);
  SeenTriangles seen = SeenTriangles(world.mesh.triangles.size());
  std::vector<std::vector<KeyedScanPtr>> scans;

  SmallMission() {
    for (const MissionRobot& robot : mission.robots) {
      scans.emplace_back(robot.key_nodes.size());
      tbb::parallel_for(size_t{0}, robot.key_nodes.size(), [&](size_t i) {
        scans.back()[i] =
            std::make_shared<const Scan>(keyedScan(robot, i, config.keyed, seen).scan);
      });
    }
  }
  SmallMission(const SmallMission&) = delete;

  static const SmallMission& shared() {
    static const SmallMission mission;
    return mission;
  }
};

}  // namespace lamp::test
