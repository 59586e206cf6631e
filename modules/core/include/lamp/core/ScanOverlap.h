#pragma once

#include <Eigen/Core>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/core/KdTree.h"

namespace lamp {

/** A scan as the overlap of two scans is measured: one point, the mean, for each voxel of 0.2 m,
 * with its normal and a search tree. Computed once, compared with many others, from any number of
 * threads. */
class OverlapScan {
 public:
  /** \param points in any frame, metres; those that are not finite are left out.
   *  \param planar the points of a level 2D laser: normals lie in the x-y plane. */
  OverlapScan(const std::vector<Eigen::Vector3f>& points, bool planar);
  OverlapScan(const OverlapScan&) = delete;  // the tree refers to the points
  OverlapScan& operator=(const OverlapScan&) = delete;

  size_t size() const { return points_.size(); }

 private:
  friend double scanOverlap(const OverlapScan& a, const OverlapScan& b, const Pose3& a_T_b);
  double shareWithPartner(const OverlapScan& other, const Eigen::Isometry3f& other_T_this) const;
  bool isFarFrom(const OverlapScan& other, const Pose3& this_T_other) const;

  std::vector<Eigen::Vector3f> points_;
  std::vector<Eigen::Vector3f> normals_;
  KdTree tree_;
  Eigen::Vector3f min_, max_;  ///< bounding box
};

/** The smaller of both scans' shares of points with a neighbour in the other one that is nearer
 * than 0.3 m and whose normal agrees within 45°, whichever side it points to. Points without a
 * normal have no partner. 0 if a scan is empty. Symmetric. */
double scanOverlap(const OverlapScan& a, const OverlapScan& b, const Pose3& a_T_b);

}  // namespace lamp
