#pragma once

#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/frontend/OdometrySource.h"
#include "lamp/scans/LocalMap.h"
#include "lamp/scans/ScanToMap.h"

namespace lamp {

/** A scan whose pose is known. */
struct LocatedScan {
  Pose3 odom_T_base = Pose3::Identity();
  std::vector<Eigen::Vector3f> points;  ///< base frame, metres
};

/** Registers a scan to a local map: from nearby first, as what lies farther off only confuses where
 * the prediction is good; where that does not suffice, with more and more effort.
 * \param error_m how far points may lie from where the prediction puts them.
 * \param good_share a scan of which this share matches need not be sought elsewhere.
 * \param reference the last scan that matched; where the prediction fails, the scan is sought
 * anywhere about it. None: only about the prediction. */
ScanToMapResult searchInMap(const FilteredScan& scan, const Pose3& predicted, double error_m,
                            double good_share, const LocatedScan* reference, LocalMap& map);

}  // namespace lamp
