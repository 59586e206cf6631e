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

  /** Of an ellipsoid of squared Mahalanobis distance at most `threshold`; at most 1. */
  double chance(const Matrix6d& covariance, double threshold) const;

 private:
  bool planar_;
  double log_volume_;
};

}  // namespace lamp
