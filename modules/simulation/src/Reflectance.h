#pragma once

#include <Eigen/Core>

#include "lamp/simulation/Mesh.h"

namespace lamp::simulation {

/** A surface as a lidar's beam meets it. */
struct LitSurface {
  Material material = Material::kRock;
  float albedo = 0;         ///< share of the light that comes back
  float cos_incidence = 1;  ///< in (0, 1]
  float range_m = 0;
};

/** Rock changes slowly from place to place, the others are even. \param point world, metres. */
float albedoOf(Material material, const Eigen::Vector3f& point);

/** Expected intensity, 0 to 1, calibrated as Velodyne's: range is made up for but for a rest,
 * diffuse surfaces end at 0.39, and retro-reflectors are above. */
float intensityOf(const LitSurface& surface);

/** Chance that enough light comes back. It fades as the incidence passes a limit, which is
 * `cos_grazing` near the sensor and grows with r²/albedo up to perpendicular for rock at
 * `max_range_m`. */
float returnProbability(const LitSurface& surface, float cos_grazing, float max_range_m);

}  // namespace lamp::simulation
