#pragma once

#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/scans/LocalMap.h"
#include "lamp/scans/MatchedSurface.h"

namespace lamp {

/** What a scan says of its pose in a local map. */
struct ScanToMapResult {
  Pose3 map_T_scan = Pose3::Identity();
  bool converged = false;    ///< false also if too few points matched
  double matched_share = 0;  ///< of the scan's points that lie on a surface of the map
  double deviation_m = 0;    ///< of matched points across their surfaces: robust standard deviation
  MatchedSurface surface;    ///< for registrationInformation()
};

/** Point-to-plane ICP (Chen, Medioni 1991) of a scan against a local map by Gauss-Newton. Matches
 * are searched within a distance that shrinks from what the prediction's error asks for to what the
 * map's spacing does; a Geman-McClure kernel as wide as the residuals scatter takes the weight from
 * bad ones. Motions that the surfaces leave free stay as predicted, about; whoever knows better
 * sets them by `surface`. Scans of a planar map are moved in x, y and yaw only.
 * \param points in the scan's frame, metres. \param max_error_m how far a point may lie from where
 * the prediction says. */
ScanToMapResult registerToMap(const std::vector<Eigen::Vector3f>& points, LocalMap& map,
                              const Pose3& predicted_map_T_scan, double max_error_m);

}  // namespace lamp
