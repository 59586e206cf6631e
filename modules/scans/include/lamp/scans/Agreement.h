#pragma once

#include "lamp/core/Geometry.h"
#include "lamp/scans/PreparedScan.h"

namespace lamp {

/** How well two scans agree at a relative pose. */
struct Agreement {
  /** Share of the source's own points with a partner of like normal among the target's own: what
   * the two scans themselves share, whatever their neighbours add. */
  double overlap = 0;
  double residual_m = 0;  ///< r.m.s. point-to-plane distance of points with any partner
  size_t matches = 0;     ///< number of those points
};

/** How near partners lie in scans of coarseness 1, metres: a little more than their spacing. */
constexpr double kPartnerDistance_m = 0.5;

/** \param distance_m how near a partner must be, for scans of coarseness 1; its normal must agree
 * within 45°, and both must have been seen from the same side: a floor is no ceiling. */
Agreement agreement(const PreparedScan& source, const PreparedScan& target,
                    const Pose3& target_T_source, double distance_m);

/** Share of the scan's points that lie where the other's rays passed, among those of which its rays
 * say anything; 0 if there are none.
 * \param other_T_scan pose of the scan; \param margin_m see FreeSpace::at(), for scans of
 * coarseness 1. */
double shareInFreeSpace(const PreparedScan& scan, const PreparedScan& other,
                        const Pose3& other_T_scan, double margin_m);

}  // namespace lamp
