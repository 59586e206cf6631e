#pragma once

#include <Eigen/Core>
#include <vector>

#include "lamp/registration/LoopClosureComputation.h"
#include "lamp/slam_app/SlamConfig.h"

namespace lamp {

/** A scan registered onto a map, without a guess. */
struct MapRegistration {
  /** In the frame of the map. */
  LoopClosureAttempt attempt;
  size_t views = 0;     ///< of the map that were tried
  size_t agreeing = 0;  ///< of these, that lead to the same pose as the best one
};

/** Registers a scan with what a lidar would see from many places in a map, z up in both. Accepted
 * if several views lead to one pose, from which the map shows most of what the scan sees, and to no
 * other that is about as good. \param viewpoint of the scan, in its frame. */
MapRegistration registerOnMap(const PreparedScan& scan, const Eigen::Vector3f& viewpoint,
                              const std::vector<Eigen::Vector3f>& map, const SlamConfig& config);

/** What a lidar would see of the map from where a scan is said to have been taken, and the scan. */
struct MapVerification {
  LoopClosureAttempt attempt;  ///< in the frame of the map; its pose is refined
  double overlap = 0;          ///< of the scan with the view
};

MapVerification verifyOnMap(const PreparedScan& scan, const Eigen::Vector3f& viewpoint,
                            const Pose3& map_T_scan, const std::vector<Eigen::Vector3f>& map,
                            const SlamConfig& config);

}  // namespace lamp
