#pragma once

#include "lamp/core/Geometry.h"

namespace lamp {

/** The part of a matrix that concerns x, y and yaw. */
Eigen::Matrix3d planarBlock(const Matrix6d& m);

/** Number of directions that an information matrix knows anything of; of [x y yaw] only if planar.
 */
int informationRank(const Matrix6d& information, bool planar);

/** Covariance of an edge whose information may be singular: directions that it does not know get a
 * standard deviation of 1000 m or rad. Of a planar edge, z, roll and pitch get a tiny one. */
Matrix6d boundedCovariance(const Matrix6d& information, bool planar);

/** Squared Mahalanobis distance. \param covariance positive definite. */
double mahalanobis2(const Vector6d& error, const Matrix6d& covariance);

}  // namespace lamp
