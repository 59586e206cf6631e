#include "PoseVolume.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "Information.h"

namespace lamp {

namespace {

/** Of the unit balls in three and six dimensions. */
const double kLogBall3 = std::log(4.0 / 3.0 * M_PI), kLogBall6 = std::log(M_PI * M_PI * M_PI / 6.0);
/** Of all rotations, in rotation vectors near the identity. */
const double kLogAllYaws = std::log(2.0 * M_PI), kLogAllRotations = std::log(8.0 * M_PI * M_PI);

template <class Matrix>
double logRootDeterminant(const Matrix& m) {
  return Matrix(m.llt().matrixL()).diagonal().array().log().sum();
}

}  // namespace

PoseVolume::PoseVolume(const std::vector<Pose3>& world_T_base, bool planar) : planar_(planar) {
  Eigen::AlignedBox3d box;
  for (const Pose3& pose : world_T_base) box.extend(pose.translation());
  const int axes = planar ? 2 : 3;
  log_volume_ = planar ? kLogAllYaws : kLogAllRotations;
  for (int axis = 0; axis < axes; ++axis)
    log_volume_ += std::log(2.0 * std::max(1.0, box.sizes()[axis]));
}

double PoseVolume::chance(const Matrix6d& covariance, double threshold) const {
  const double log_ellipsoid =
      planar_ ? kLogBall3 + 1.5 * std::log(threshold) + logRootDeterminant(planarBlock(covariance))
              : kLogBall6 + 3.0 * std::log(threshold) + logRootDeterminant(covariance);
  return std::min(1.0, std::exp(log_ellipsoid - log_volume_));
}

}  // namespace lamp
