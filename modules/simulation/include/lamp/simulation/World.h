#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/simulation/Artifacts.h"
#include "lamp/simulation/Layout.h"
#include "lamp/simulation/Mesh.h"

namespace lamp::simulation {

/** A synthetic place with known truth. World frame, metres; z up. */
struct World {
  Layout layout;
  Mesh mesh;
  Pose3 world_T_gate = Pose3::Identity();  ///< in the gate's opening on the floor, x into the world
  std::vector<Eigen::Vector3d> plates;     ///< middles of the three reflective plates on the gate
  std::vector<Artifact> artifacts;
};

/** A robot of the paper's experiments (III): name, way, lidars, and LAMP 1.0's ATE. */
struct PaperRobot {
  std::string name;
  double length_m;
  std::vector<std::string> lidars;
  double lamp1_ate_m;
};

/** A kind of world, named after one of the paper's data sets. */
struct WorldKind {
  std::string name, meaning;
  std::vector<PaperRobot> robots;
  double cell_m;  ///< of the walls' triangles
  /** \param length_m of all robots' ways together: how large the world has to be. */
  std::function<World(double length_m, double cell_m, uint64_t seed)> make;
};

/** tunnel, urban, finals, ku, demo. */
const std::vector<WorldKind>& worldKinds();
/** \throws std::runtime_error listing the known ones. */
const WorldKind& worldKind(const std::string& name);

}  // namespace lamp::simulation
