#pragma once

#include <Eigen/Core>
#include <vector>

#include "lamp/frontend/GateCalibration.h"

namespace lamp {

/** For each ray whether it shines: its intensity is `ratio` times what nine of ten rays of this
 * lidar from about as far stay below. */
std::vector<bool> shining(const std::vector<LidarRay>& rays, double ratio);

/** Points that lie together. */
struct ReflectorCluster {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3f> points;
};

/** Euclidean clusters, in the order of their first points: points nearer than about `size_m` to
 * each other are together. Left out are those that are larger than a square plate with edges of
 * `size_m`, and those of few points. */
std::vector<ReflectorCluster> reflectorClusters(const std::vector<Eigen::Vector3f>& points,
                                                double size_m);

}  // namespace lamp
