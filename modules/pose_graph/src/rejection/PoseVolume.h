#pragma once

#include "rejection/OdometryChains.h"

namespace lamp {

/** How likely a relative pose lies within some region by chance, if it is uniform over a map:
 * positions over twice the map's extent along each axis, rotations over all there are. */
class PoseVolume {
 public:
  /** The extent is that of the odometry of all chains, as if they all started at one place, and at
   * least 1 m. */
  PoseVolume(const PoseGraph& graph, const OdometryChains& chains);
  /** The extent is that of the estimates. */
  explicit PoseVolume(const PoseGraph& graph);

  /** The chance for the ellipsoid of squared Mahalanobis distance `threshold`: its volume over the
   * map's, at most 1. What extends beyond the map is cut off, roughly. */
  double chance(const Matrix6d& covariance, double threshold) const;
  /** The chance for the ellipsoid that holds 99 % of true relative poses. */
  double chance(const Matrix6d& covariance) const { return chance(covariance, usual_); }
  /** Squared Mahalanobis distance of that ellipsoid. */
  double usualThreshold() const { return usual_; }

 private:
  void setExtent(const Eigen::Vector3d& extent);

  const bool planar_;
  const double usual_;
  Vector6d sides_;  ///< of a box with the volume of all relative poses
};

}  // namespace lamp
