#pragma once

#include "lamp/core/PoseGraph.h"
#include "lamp/pose_graph/OutlierRejection.h"

namespace lamp {

/** How likely a relative pose lies somewhere by chance, if it is uniform over a map: positions over
 * twice its extent each way, rotations over all. */
class PoseVolume {
 public:
  /** \param world_T_base that make the map; extents below 1 m count as 1 m. */
  PoseVolume(const std::vector<Pose3>& world_T_base, bool planar);

  /** Of an ellipsoid of squared Mahalanobis distance at most `threshold`: the ratio of volumes, at
   * most 1, with an ellipsoid that leaves the map cut there, roughly. */
  double chance(const Matrix6d& covariance, double threshold) const;

 private:
  bool planar_;
  Vector6d sides_;  ///< of a box with the volume of all relative poses
};

}  // namespace lamp
