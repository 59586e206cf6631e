#pragma once

#include "lamp/core/Geometry.h"

namespace lamp {

/** Errors of measurements that concern points and directions, all in space. Null pointers ask for
 * no Jacobian. */

/** Rotation vector, in the base frame, from the measured direction of gravity to the estimated one:
 * to first order what Log(measured⁻¹ · pose) has at right angles to it.
 * \param d_rotation with respect to a right perturbation of the estimated rotation. */
Eigen::Vector3d gravityError(const Eigen::Matrix3d& measured_world_R_base,
                             const Eigen::Matrix3d& world_R_base, Eigen::Matrix3d* d_rotation);

/** How far off `estimated` is: in distance, along `measured`, and in direction, across it, as an
 * arc at the measured distance. Both are vectors from the sensor.
 * \param d_estimated with respect to `estimated`. */
Eigen::Vector3d bearingRangeError(const Eigen::Vector3d& measured, const Eigen::Vector3d& estimated,
                                  Eigen::Matrix3d* d_estimated);

/** \param between the vector from one antenna to the other, metres. */
double rangeError(double measured_m, const Eigen::Vector3d& between, Eigen::RowVector3d* d_between);

}  // namespace lamp
