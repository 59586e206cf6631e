#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lamp/core/Geometry.h"

namespace lamp {

/** Places of the same physical point in two frames, metres. */
struct PointPair {
  Eigen::Vector3d source, target;
};

/** The rotation that takes `source` vectors to `target` vectors, which may hold outliers, by
 * graduated non-convexity over truncated least squares (Yang et al., TEASER, T-RO 2021, section
 * VI; Yang et al., GNC, RA-L 2020). Wahba's problem is solved in each round by a singular value
 * decomposition.
 * \param noise_m error of a vector that an inlier may have. \param upright about z only. */
Eigen::Matrix3d robustRotation(const std::vector<PointPair>& vectors, double noise_m, bool upright);

/** The value that most of the measurements agree on within `noise`: the mean of the largest set of
 * measurements that lie in an interval of `2 noise` (adaptive voting, TEASER section V); 0 if there
 * are none. */
double adaptiveVote(std::vector<double> measurements, double noise);

/** target_T_source from pairs of points of which some are wrong: rotation from the differences of
 * points, which know nothing of the translation, then each coordinate of the translation by
 * voting, last the least-squares pose of the inliers.
 * \return none with fewer than three pairs, or if fewer than three agree. */
std::optional<Pose3> robustPose(const std::vector<PointPair>& pairs, double noise_m, bool upright);

/** Least-squares pose (Umeyama 1991, without scale). \param pairs at least one. */
Pose3 leastSquaresPose(const std::vector<PointPair>& pairs, bool upright);

}  // namespace lamp
