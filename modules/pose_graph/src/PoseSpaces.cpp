#include "PoseSpaces.h"

#include <cmath>

namespace lamp {

Se3::Pose Se3::load(const double* block) {
  Pose T = Pose::Identity();
  T.translation() = Eigen::Map<const Eigen::Vector3d>(block);
  T.linear() = Eigen::Map<const Eigen::Quaterniond>(block + 3).toRotationMatrix();
  return T;
}

void Se3::store(const Pose& T, double* block) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(T.linear()).normalized();
  Eigen::Map<Eigen::Vector3d> translation(block);
  translation = T.translation();
  Eigen::Map<Eigen::Vector4d> rotation(block + 3);
  rotation = q.coeffs();
}

Se3::Pose Se3::plus(const Pose& T, const Tangent& d) {
  return T * expSE3(d);
}

Se3::Tangent Se3::minus(const Pose& to, const Pose& from) {
  return logSE3(from.inverse() * to);
}

Se3::Tangent Se3::relativeError(const Pose& from_T_to, const Pose& from, const Pose& to,
                                Jacobian* d_from, Jacobian* d_to) {
  const Pose estimated = from.inverse() * to;
  const Tangent error = logSE3(from_T_to.inverse() * estimated);
  if (!d_from && !d_to) return error;
  const Jacobian d_right = rightJacobianInverse(error);
  if (d_to) *d_to = d_right;
  if (d_from) *d_from = -d_right * adjoint(estimated.inverse());
  return error;
}

Se3::Tangent Se3::priorError(const Pose& measured, const Pose& pose, Jacobian* d_pose) {
  const Tangent error = logSE3(measured.inverse() * pose);
  if (d_pose) *d_pose = rightJacobianInverse(error);
  return error;
}

namespace {

double wrapped(double angle) {
  return std::remainder(angle, 2.0 * M_PI);
}

Eigen::Matrix2d rotation(double yaw) {
  return Eigen::Rotation2Dd(yaw).toRotationMatrix();
}

/** `a⁻¹ · b`, yaw wrapped. */
Eigen::Vector3d between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Vector3d a_T_b;
  a_T_b << rotation(a.z()).transpose() * (b - a).head<2>(), wrapped(b.z() - a.z());
  return a_T_b;
}

Eigen::Matrix3d rotationBlock(double yaw) {
  Eigen::Matrix3d block = Eigen::Matrix3d::Identity();
  block.topLeftCorner<2, 2>() = rotation(yaw);
  return block;
}

}  // namespace

Se2::Pose Se2::fromPose3(const Pose3& T) {
  return {T.translation().x(), T.translation().y(), yawOf(T)};
}

Se2::Jacobian Se2::information(const Matrix6d& m) {
  Jacobian planar;
  for (int row = 0; row < kDof; ++row)
    for (int column = 0; column < kDof; ++column)
      planar(row, column) = m(kPlanarAxes[row], kPlanarAxes[column]);
  return planar;
}

Se2::Pose Se2::plus(const Pose& p, const Tangent& d) {
  return p + rotationBlock(p.z()) * d;
}

Se2::Tangent Se2::minus(const Pose& to, const Pose& from) {
  return between(from, to);
}

Se2::Tangent Se2::relativeError(const Pose& from_T_to, const Pose& from, const Pose& to,
                                Jacobian* d_from, Jacobian* d_to) {
  const Pose estimated = between(from, to);
  const Tangent error = between(from_T_to, estimated);
  if (d_to) *d_to = rotationBlock(error.z());
  if (d_from) {
    Jacobian d_estimated = -Jacobian::Identity();
    d_estimated(0, 2) = estimated.y();
    d_estimated(1, 2) = -estimated.x();
    *d_from = rotationBlock(from_T_to.z()).transpose() * d_estimated;
  }
  return error;
}

Se2::Tangent Se2::priorError(const Pose& measured, const Pose& pose, Jacobian* d_pose) {
  const Tangent error = between(measured, pose);
  if (d_pose) *d_pose = rotationBlock(error.z());
  return error;
}

}  // namespace lamp
