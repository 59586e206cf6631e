#pragma once

#include "lamp/core/Geometry.h"

namespace lamp {

/** The part of a matrix that concerns x, y and yaw. */
Eigen::Matrix3d planarBlock(const Matrix6d& m);

/** Number of directions in which an information matrix knows anything; if planar, of [x y yaw]
 * only. */
int informationRank(const Matrix6d& information, bool planar);

/** Covariance of an edge whose information may be singular: unknown directions get a standard
 * deviation of 1000 m or rad. For a planar edge, z, roll and pitch get a tiny one. */
Matrix6d boundedCovariance(const Matrix6d& information, bool planar);

/** Squared Mahalanobis distance. \param covariance positive definite. */
double mahalanobis2(const Vector6d& error, const Matrix6d& covariance);

}  // namespace lamp
