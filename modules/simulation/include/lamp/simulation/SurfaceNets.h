#pragma once

#include "lamp/simulation/FreeSpace.h"

namespace lamp::simulation {

/** The walls of a free space as triangles about `cell_m` wide: naive surface nets (Gibson,
 * "Constrained Elastic Surface Nets", MICCAI 1998) on the blocks of a grid that walls pass. Runs on
 * the caller's TBB arena; the mesh does not depend on the number of threads. */
Mesh wallMesh(const FreeSpace& space, double cell_m);

}  // namespace lamp::simulation
