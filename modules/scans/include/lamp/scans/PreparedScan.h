#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/core/KeyedScan.h"
#include "lamp/core/KdTree.h"

namespace lamp {

/** A cloud for registration, with all that is computed from it once: search tree and normals.
 *
 * The covariance of a point in generalised ICP follows from its normal alone (Segal, Haehnel,
 * Thrun, RSS 2009): one along the surface, almost none across it. So normals are all that is
 * stored.
 */
struct PreparedScan {
  std::vector<Eigen::Vector3f> points;   ///< in the frame of the key node, metres
  std::vector<Eigen::Vector3f> normals;  ///< unit length; zero where the surface is unknown
  bool planar = false;                   ///< points of a level 2D laser: normals lie in the plane
  std::unique_ptr<const KdTree> tree;

  size_t size() const { return points.size(); }
};
using PreparedScanPtr = std::shared_ptr<const PreparedScan>;

/** \param normal_neighbors how many nearest points a normal is fitted to.
 *  \param planar normals are lines' normals in the x-y plane. */
PreparedScanPtr prepareScan(std::vector<Eigen::Vector3f> points, int normal_neighbors, bool planar);

/** A keyed scan and where it lies in the frame that clouds are accumulated in. */
struct PlacedScan {
  KeyedScanPtr scan;
  Pose3 target_T_scan = Pose3::Identity();
};

/** The points of several scans in one frame. */
std::vector<Eigen::Vector3f> accumulate(const std::vector<PlacedScan>& scans);

}  // namespace lamp
