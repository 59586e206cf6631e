#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/core/KeyedScan.h"

namespace lamp {

/** Points in one frame, metres, each with the place that it was seen from: those of a scan, and
 * perhaps of its neighbours. */
struct Cloud {
  std::vector<Eigen::Vector3f> points;
  std::vector<uint32_t> viewpoint;          ///< of each point: place in `viewpoints`
  std::vector<Eigen::Vector3f> viewpoints;  ///< where the lidars stood, the scan's own first
  size_t own_viewpoints = 1;                ///< how many are the scan's own

  size_t size() const { return points.size(); }
  bool isOwn(size_t i) const { return viewpoint[i] < own_viewpoints; }
  const Eigen::Vector3f& viewpointOf(size_t i) const { return viewpoints[viewpoint[i]]; }
};

/** Finite, and within 1000 km: what a cell of a grid can be computed for. */
bool isUsable(const Eigen::Vector3f& point);

/** Points that were all seen from the origin of their frame. */
Cloud cloudSeenFromOrigin(std::vector<Eigen::Vector3f> points);

/** A keyed scan and where it lies in the frame that clouds are accumulated in. */
struct PlacedScan {
  KeyedScanPtr scan;
  Pose3 target_T_scan = Pose3::Identity();
};

/** The points of several scans in one frame. All of the first one's, which is the cloud's own; of
 * the others, those in cells of a grid with edge `leaf_m` (metres) where there is nothing yet: they
 * fill what the own scan did not see, and do not blur what it saw. */
Cloud accumulate(const std::vector<PlacedScan>& scans, double leaf_m);

/** One point, the mean, for each occupied cell of a grid with edge `leaf_m` (metres); its viewpoint
 * is that of the cell's first point. Order: by first point. \param cloud usable points only. */
Cloud voxelMeans(const Cloud& cloud, double leaf_m);

/** Turns the normals of the cloud's points towards where the points were seen from. */
void turnTowardsViewpoints(const Cloud& cloud, std::vector<Eigen::Vector3f>& normals);

}  // namespace lamp
