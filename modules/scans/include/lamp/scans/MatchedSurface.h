#pragma once

#include "lamp/core/Geometry.h"
#include "lamp/scans/PreparedScan.h"

namespace lamp {

/** What two scans say of their relative pose: the surfaces that both have seen. Points whose normal
 * comes from the pattern of the scan rather than from a surface hold nothing (see
 * SurfaceSupport), and neither does where the rays end. */
struct MatchedSurface {
  /** The A of the paper's observability analysis: sum of Hᵀ H over the matched points on surfaces
   * with their weights, H the derivative of the point-to-plane distance (metres) by a motion about
   * `pivot` in the target's axes. */
  Matrix6d information = Matrix6d::Zero();
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();  ///< centroid of the source, in the target
  double weights = 0;                               ///< sum over those points
  double patches = 0;     ///< pieces of surface, about a metre wide, that they lie on
  double radius_m = 0;    ///< r.m.s. distance of the source's points from the pivot
  double residual_m = 0;  ///< weighted r.m.s. point-to-plane distance of all matched points
};

/** \param distance_m how near a partner must lie, and \param kernel_m the residual at which a match
 * loses three quarters of its weight, both for scans of coarseness 1. */
MatchedSurface matchedSurface(const PreparedScan& source, const PreparedScan& target,
                              const Pose3& target_T_source, double distance_m, double kernel_m);

}  // namespace lamp
