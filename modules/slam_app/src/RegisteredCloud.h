#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "lamp/core/KeyedScan.h"
#include "lamp/frontend/FrontEnd.h"

namespace lamp {

/** A cloud of a file, and what of it is registered. */
struct RegisteredCloud {
  std::string path;
  size_t read = 0;      ///< points in the file
  size_t left_out = 0;  ///< of these, that are not finite, no return, too far away, or noise
  double leaf_m = 0;    ///< of the voxel filter; 0 if it was not needed
  KeyedScanPtr scan;    ///< in world coordinates less the offset
  /** What to add for world coordinates, metres: of maps that state it, and of clouds in a national
   * grid or UTM. */
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  /** All points, if the cloud was not seen from one place; else empty. */
  std::vector<Eigen::Vector3f> map;
  std::vector<std::string> notes;  ///< what may stand in the way of a good registration
};

/** Source and target, each thinned as the front end thins scans. Where both have an offset and lie
 * in one region, it is the same.
 * \throws std::runtime_error naming the file that cannot be used, and what to do. */
std::pair<RegisteredCloud, RegisteredCloud> loadClouds(const std::string& source,
                                                       const std::string& target,
                                                       const FrontEndOptions& options);

}  // namespace lamp
