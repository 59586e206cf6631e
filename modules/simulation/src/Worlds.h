#pragma once

#include "WorldBuilder.h"

namespace lamp::simulation {

/** Narrow coal-mine drives with rough walls and regular cross-cuts, `drives_m` long together; the
 * first junction lies `lead_m` along x from the place `gate`. */
void addCoalMine(double drives_m, size_t gate, double lead_m, WorldBuilder& builder);
/** Drives 10 to 20 m wide between pillars of rock, in the same manner. */
void addLimestoneMine(double drives_m, size_t gate, double lead_m, WorldBuilder& builder);
/** A building of two floors along x from the place `gate`: on each about `ways_m` of corridors with
 * halls between and rooms beside them, and a stair at each end. */
void addBuilding(double ways_m, size_t gate, double lead_m, WorldBuilder& builder);
/** A winding ring of uneven passages and chambers, `ways_m` long, along y from the place `gate`. */
void addCave(double ways_m, size_t gate, double lead_m, WorldBuilder& builder);

World makeTunnel(double length_m, double cell_m, uint64_t seed);
World makeUrban(double length_m, double cell_m, uint64_t seed);
World makeFinals(double length_m, double cell_m, uint64_t seed);
World makeKu(double length_m, double cell_m, uint64_t seed);
World makeDemo(double length_m, double cell_m, uint64_t seed);

}  // namespace lamp::simulation
