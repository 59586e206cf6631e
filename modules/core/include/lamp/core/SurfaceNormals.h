#pragma once

#include <Eigen/Core>
#include <vector>

#include "lamp/core/KdTree.h"

namespace lamp {

/** Unit normals of the surface that the points lie on, without a known side; zero where the
 * surface is unknown.
 * \param tree over `points`; \param neighbors how many nearest points a normal is fitted to.
 * \param planar the points of a level 2D laser: normals of lines, in the x-y plane. */
std::vector<Eigen::Vector3f> surfaceNormals(const std::vector<Eigen::Vector3f>& points,
                                            const KdTree& tree, int neighbors, bool planar);

}  // namespace lamp
