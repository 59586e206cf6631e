#pragma once

#include <Eigen/Geometry>

namespace lamp {

/** A pose `target_T_source`: maps points of source into target. Metres. */
using Pose3 = Eigen::Isometry3d;
/** Tangent vectors and covariances are ordered `[x y z, rx ry rz]` and live in the tangent space at
 * the pose: right perturbation, `T ⊞ d = T · Exp(d)`. Metres and radians. */
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/** The tangent coordinates in which a planar robot moves: x, y, and the rotation about z. */
constexpr int kPlanarAxes[3] = {0, 1, 5};

Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/** Exponential map of SE(3) with translation first. */
Pose3 expSE3(const Vector6d& d);
/** Inverse of expSE3(); rotation part within [0, pi]. */
Vector6d logSE3(const Pose3& T);

/** `T · Exp(d) = Exp(Ad(T) d) · T`. */
Matrix6d adjoint(const Pose3& T);
/** `Log(T · Exp(d)) ≈ Log(T) + Jr⁻¹ d` with `Jr⁻¹ = rightJacobianInverse(Log(T))`. */
Matrix6d rightJacobianInverse(const Vector6d& log);

/** Covariance of `a_T_c = a_T_b · b_T_c` in the tangent space at the result, for independent
 * factors: the first one's is carried over by the adjoint of the second. */
Matrix6d composeCovariance(const Matrix6d& a_cov_b, const Pose3& b_T_c, const Matrix6d& b_cov_c);

/** Constant-twist interpolation between two poses; `ratio` 0 gives a, 1 gives b. */
Pose3 interpolate(const Pose3& a, const Pose3& b, double ratio);

/** Rotation angle in [0, pi]. */
double rotationAngle(const Pose3& T);

/** The pose in the x-y plane: z, roll and pitch are zero. */
Pose3 planarPose(double x, double y, double yaw);
/** Yaw of the pose, as MRPT's `yaw pitch roll` defines it. */
double yawOf(const Pose3& T);
/** Drops z, roll and pitch. */
Pose3 projectToPlane(const Pose3& T);

/** `[x y z yaw pitch roll]` (MRPT's order; radians) to a pose, and back. */
Pose3 poseFromYawPitchRoll(const Vector6d& xyz_ypr);
Vector6d yawPitchRollFromPose(const Pose3& T);

/** Re-orthonormalises the rotation, which long chains of products let drift. */
Pose3 normalized(const Pose3& T);

bool isFinite(const Pose3& T);
/** Finite, symmetric, and positive definite. */
bool isCovariance(const Matrix6d& m);

}  // namespace lamp
