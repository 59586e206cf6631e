#pragma once

#include "rejection/OdometryChains.h"

namespace lamp {

/** How likely a relative pose lies somewhere by chance, if it is uniform over a map: positions over
 * twice its extent each way, rotations over all. */
class PoseVolume {
 public:
  /** The extent is that of the odometry of all chains, as if all started at one place. Below 1 m it
   * counts as 1 m. */
  PoseVolume(const PoseGraph& graph, const OdometryChains& chains);
  /** The extent is that of the estimates. */
  explicit PoseVolume(const PoseGraph& graph);

  /** Of an ellipsoid of squared Mahalanobis distance at most `threshold`: the ratio of volumes, at
   * most 1, with an ellipsoid that leaves the map cut there, roughly. */
  double chance(const Matrix6d& covariance, double threshold) const;
  /** Of the ellipsoid that 99 % of the true ones lie in. */
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
