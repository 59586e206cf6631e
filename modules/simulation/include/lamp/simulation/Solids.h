#pragma once

#include <Eigen/Geometry>

#include "lamp/simulation/Mesh.h"
#include "lamp/simulation/Random.h"

namespace lamp::simulation {

/** Meshes of things that stand in a world, closed, seen from outside. World frame, metres. Faces
 * are divided into triangles no wider than 0.3 m, so that what a scan saw of them can be marked. */

/** A box with its bottom in the x-y plane of `world_T_box`, centred there. */
Mesh box(const Eigen::Isometry3d& world_T_box, const Eigen::Vector3d& size, Material material);

/** A pipe or cable between two points, with `sides` faces; open at its ends. */
Mesh pipe(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius_m, int sides,
          Material material);

/** A lump of rock of no particular shape, sunk a little into the floor at `foot`. */
Mesh boulder(const Eigen::Vector3d& foot, double radius_m, Random& random);

/** A rectangle of `size` (across, up) around the middle of `world_T_plate`, facing its x axis. */
Mesh plate(const Eigen::Isometry3d& world_T_plate, const Eigen::Vector2d& size, Material material);

}  // namespace lamp::simulation
