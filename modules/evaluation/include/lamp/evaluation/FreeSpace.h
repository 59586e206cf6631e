#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "lamp/evaluation/TrueSurface.h"

namespace lamp::evaluation {

/** Calls `take` with the centre of each truly free voxel: one that is joined with a robot's true
 * position through voxels without surface samples (over faces), and has no surface sample in its 26
 * neighbours either, so that nobody is punished for rounding to voxels. Only within the bounding
 * box of the seen samples. Samples 0.1 m apart are watertight from voxels of 0.2 m on.
 * \throws std::runtime_error if the box has too many voxels to keep in memory. */
void forEachFreeVoxel(const SurfaceSamples& surface, const std::vector<Eigen::Vector3f>& positions,
                      double voxel_m, const std::function<void(const Eigen::Vector3d&)>& take);

}  // namespace lamp::evaluation
