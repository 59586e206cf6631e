#pragma once

#include <map>
#include <string>
#include <vector>

#include "lamp/core/Ini.h"
#include "lamp/simulation/Artifacts.h"
#include "lamp/simulation/Drive.h"
#include "lamp/simulation/Imu.h"
#include "lamp/simulation/Lidar.h"
#include "lamp/simulation/Link.h"
#include "lamp/simulation/Movers.h"
#include "lamp/simulation/OdometryModel.h"
#include "lamp/simulation/Radio.h"
#include "lamp/simulation/World.h"

namespace lamp::simulation {

struct WorldOptions {
  int robots = 0;
  double distance_scale = 1;
  double cell_m = 0;
  double start_interval_s = 60;
  double truth_spacing_m = 0;
  int loop_pairs = 1200;

  void visit(OptionVisitor& v);
};

struct KeyedOptions {
  double key_node_distance_m = 2.0;
  double key_node_angle_deg = 30.0;
  int max_points = 4000;
  double rotation_s = 1.0;

  void visit(OptionVisitor& v);
};

/** One robot of a simulated team. */
struct SimulatedRobotOptions {
  std::string name;  ///< NAME of the sections `[robot.NAME]`, `[drive.NAME]`, `[odometry.NAME]`
  double length_m = 100;
  std::vector<std::string> lidars;
  DriveOptions drive;
  OdometryOptions odometry;

  void visit(OptionVisitor& v);
};

/** All that decides what `lamp-sim` makes, beside the seed. */
struct SimConfig {
  /** Reads an ini over the defaults of a kind of world. Robots are those of the paper, or as many
   * as `world.robots` says: more than in the paper repeat them, as `husky1_2`.
   * \throws ConfigError listing all faults, as the reader of `lamp-slam` does. */
  SimConfig(const WorldKind& kind, const Ini& ini, Faults faults);

  const WorldKind* kind;
  WorldOptions world;
  KeyedOptions keyed;
  ImuOptions imu;
  RadioOptions radio;
  LinkOptions link;
  ArtifactOptions artifacts;
  MoverOptions movers;
  std::vector<SimulatedRobotOptions> robots;
  std::map<std::string, LidarOptions> lidars;  ///< `[lidar.NAME]`

  /** The complete ini; reads back to the same. */
  std::string text() const;
  double totalLength() const;
  /** Those of the world where `[world]` says 0. */
  double cellM() const { return world.cell_m > 0 ? world.cell_m : kind->cell_m; }
  double truthSpacingM() const;
};

}  // namespace lamp::simulation
