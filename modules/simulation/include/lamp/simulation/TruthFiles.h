#pragma once

#include <string>
#include <vector>

#include "lamp/simulation/KeyedScans.h"
#include "lamp/simulation/LoopPairs.h"

namespace lamp::simulation {

/** `map.ply`: samples of all surfaces about `spacing_m` apart, with the normal towards free space
 * and whether any scan hit their triangle. Binary. \return the number of samples. */
size_t writeTruthMap(const std::string& path, const Mesh& mesh, const SeenTriangles& seen,
                     double spacing_m);

/** `world.json`: world and seed, gate, plates, beacons, artifacts, robots and their start poses. */
std::string worldJson(const World& world, const Mission& mission, const std::string& kind,
                      uint64_t seed);

/** `loop_pairs.csv`. */
std::string loopPairsCsv(const std::vector<LoopPair>& pairs, const Mission& mission);

/** `<robot>.tum`: world_T_base at each scan. */
std::string truthTum(const MissionRobot& robot);

/** `<robot>.movers.ply`: `scan x y z` of the returns from movers: the row of `<robot>.tum`, and the
 * point in the base's frame there, metres. Binary. */
std::string moversPly(const MovingPoints& moving);

/** `<robot>.arrivals.csv`: stamp of each key node, and when it reaches the base. */
std::string arrivalsCsv(const MissionRobot& robot);

/** The experiment file for `lamp-slam`, with paths relative to it. */
std::string slamIni(const World& world, const Mission& mission, bool keyed);

}  // namespace lamp::simulation
