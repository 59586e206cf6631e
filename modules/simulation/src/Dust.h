#pragma once

#include "lamp/simulation/Lidar.h"

namespace lamp::simulation {

/** Density of returns from dust at a stamp, per metre of a ray: zero but for clouds that rise and
 * settle within a time patch. */
double dustPerMetre(const LidarOptions& options, double stamp, uint64_t seed);

}  // namespace lamp::simulation
