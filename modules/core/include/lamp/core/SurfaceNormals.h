#pragma once

#include <Eigen/Core>
#include <vector>

#include "lamp/core/KdTree.h"

namespace lamp {

/** The planes that fit points and their neighbours; for a level 2D laser, lines. */
struct FittedPlanes {
  /** Unit length, without a known side; zero where the surface is unknown. */
  std::vector<Eigen::Vector3f> normals;
  /** Standard deviation of the neighbours from the plane: noise, and how rough the surface is; zero
   * where it is unknown. */
  std::vector<float> deviations_m;
  /** How wide the neighbours lie along the plane, standard deviation; zero where it is unknown. */
  std::vector<float> extents_m;
};

/** \param tree over `points`; \param neighbors how many nearest points a plane is fitted to.
 * \param planar the points of a level 2D laser: lines with normals in the x-y plane. */
FittedPlanes fitPlanes(const std::vector<Eigen::Vector3f>& points, const KdTree& tree,
                       int neighbors, bool planar);

}  // namespace lamp
