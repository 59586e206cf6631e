#pragma once

#include <Eigen/Core>
#include <vector>

#include "lamp/core/Geometry.h"

namespace lamp {

/** How well two scans pin down their relative pose. */
struct Observability {
  /** How many of the points constrain motion along each axis of `translations`, and about each of
   * `rotations`, while the other motions adapt: 1 if all do, 0 if none does. Ascending. */
  Eigen::Vector3d translation = Eigen::Vector3d::Zero(), rotation = Eigen::Vector3d::Zero();
  Eigen::Matrix3d translations = Eigen::Matrix3d::Identity(),
                  rotations = Eigen::Matrix3d::Identity();  ///< unit axes, as columns
};

/** \param information sum of Hᵀ H about the pivot (paper II-C, loop closure prioritization), of
 *    unit weights; metres.
 *  \param points how many of them; \param radius_m their r.m.s. distance from the pivot, by which
 *    rotations are made lengths. */
Observability observability(const Matrix6d& information, double points, double radius_m);

}  // namespace lamp
