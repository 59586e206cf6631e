#include "solver/PoseSpaces.h"

#include <cmath>

#include "solver/PointErrors.h"

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

Se3::Tangent Se3::gravityError(const Pose& measured, const Pose& pose, Jacobian* d_pose) {
  Eigen::Matrix3d d_rotation;
  Tangent error = Tangent::Zero();
  error.tail<3>() =
      lamp::gravityError(measured.linear(), pose.linear(), d_pose ? &d_rotation : nullptr);
  if (d_pose) {
    d_pose->setZero();
    d_pose->bottomRightCorner<3, 3>() = d_rotation;
  }
  return error;
}

PosedPoint<6> Se3::toWorld(const Pose& T, const Eigen::Vector3d& local) {
  PosedPoint<6> point;
  point.p = T * local;
  point.d_pose << T.linear(), -T.linear() * skew(local);
  return point;
}

PosedPoint<6> Se3::toLocal(const Pose& T, const Eigen::Vector3d& world) {
  PosedPoint<6> point;
  point.p = T.linear().transpose() * (world - T.translation());
  point.d_pose << -Eigen::Matrix3d::Identity(), skew(point.p);
  return point;
}

Se3::Jacobian Se3::positionAndYaw(const Pose& T) {
  const Eigen::Vector3d up = T.linear().row(2);
  Jacobian projection = Jacobian::Identity();
  projection.bottomRightCorner<3, 3>() = up * up.transpose();
  return projection;
}

namespace {

double wrapped(double angle) {
  return angle - 2.0 * M_PI * std::nearbyint(angle / (2.0 * M_PI));
}

/** `a⁻¹ · b`, yaw wrapped. */
Pose2 between(const Pose2& a, const Pose2& b) {
  const double dx = b.position.x() - a.position.x(), dy = b.position.y() - a.position.y();
  return {a.cosine * dx + a.sine * dy, a.cosine * dy - a.sine * dx, wrapped(b.yaw - a.yaw),
          a.cosine * b.cosine + a.sine * b.sine, a.cosine * b.sine - a.sine * b.cosine};
}

Eigen::Vector3d coordinates(const Pose2& p) {
  return {p.position.x(), p.position.y(), p.yaw};
}

}  // namespace

Pose2::Pose2(double x, double y, double yaw_rad)
    : Pose2(x, y, yaw_rad, std::cos(yaw_rad), std::sin(yaw_rad)) {}

Eigen::Matrix2d Pose2::rotation() const {
  Eigen::Matrix2d R;
  R << cosine, -sine, sine, cosine;
  return R;
}

Se2::Pose Se2::fromPose3(const Pose3& T) {
  return {T.translation().x(), T.translation().y(), yawOf(T)};
}

void Se2::store(const Pose& p, double* block) {
  Eigen::Map<Eigen::Vector3d> stored(block);
  stored = coordinates(p);
}

Se2::Jacobian Se2::information(const Matrix6d& m) {
  Jacobian planar;
  for (int row = 0; row < kDof; ++row)
    for (int column = 0; column < kDof; ++column)
      planar(row, column) = m(kPlanarAxes[row], kPlanarAxes[column]);
  return planar;
}

Se2::Pose Se2::plus(const Pose& p, const Tangent& d) {
  const Eigen::Vector2d moved = p.position + p.rotation() * d.head<2>();
  return {moved.x(), moved.y(), p.yaw + d.z()};
}

Se2::Tangent Se2::minus(const Pose& to, const Pose& from) {
  return coordinates(between(from, to));
}

Se2::Tangent Se2::relativeError(const Pose& from_T_to, const Pose& from, const Pose& to,
                                Jacobian* d_from, Jacobian* d_to) {
  const Pose estimated = between(from, to);
  const Pose error = between(from_T_to, estimated);
  if (d_to) *d_to = rotation(error);
  if (d_from) {
    const double c = from_T_to.cosine, s = from_T_to.sine;
    const double x = estimated.position.x(), y = estimated.position.y();
    *d_from << -c, -s, c * y - s * x,  //
        s, -c, -s * y - c * x,         //
        0, 0, -1;
  }
  return coordinates(error);
}

Se2::Tangent Se2::priorError(const Pose& measured, const Pose& pose, Jacobian* d_pose) {
  const Pose error = between(measured, pose);
  if (d_pose) *d_pose = rotation(error);
  return coordinates(error);
}

Se2::Tangent Se2::gravityError(const Pose&, const Pose&, Jacobian* d_pose) {
  if (d_pose) d_pose->setZero();
  return Tangent::Zero();
}

PosedPoint<3> Se2::toWorld(const Pose& p, const Eigen::Vector3d& local) {
  const Eigen::Matrix2d R = p.rotation();
  PosedPoint<3> point;
  point.p << p.position + R * local.head<2>(), local.z();
  point.d_pose.setZero();
  point.d_pose.topLeftCorner<2, 2>() = R;
  point.d_pose.topRightCorner<2, 1>() = R * Eigen::Vector2d(-local.y(), local.x());
  return point;
}

PosedPoint<3> Se2::toLocal(const Pose& p, const Eigen::Vector3d& world) {
  PosedPoint<3> point;
  point.p << p.rotation().transpose() * (world.head<2>() - p.position), world.z();
  point.d_pose.setZero();
  point.d_pose.topLeftCorner<2, 2>() = -Eigen::Matrix2d::Identity();
  point.d_pose.topRightCorner<2, 1>() << point.p.y(), -point.p.x();
  return point;
}

Eigen::Matrix3d Se2::rotation(const Pose& p) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = p.rotation();
  return R;
}

}  // namespace lamp
