#include "lamp/core/Geometry.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace lamp {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSmallAngle = 1e-4;

/** Coefficients of the left Jacobian of SO(3): J = I + a·W + b·W². */
void jacobianCoefficients(double theta, double& a, double& b) {
  const double t2 = theta * theta;
  if (theta < kSmallAngle) {
    a = 0.5 - t2 / 24.0;
    b = 1.0 / 6.0 - t2 / 120.0;
  } else {
    a = (1.0 - std::cos(theta)) / t2;
    b = (theta - std::sin(theta)) / (t2 * theta);
  }
}

Matrix3d leftJacobianSO3(const Vector3d& w) {
  double a, b;
  jacobianCoefficients(w.norm(), a, b);
  const Matrix3d W = skew(w);
  return Matrix3d::Identity() + a * W + b * W * W;
}

Matrix3d leftJacobianInverseSO3(const Vector3d& w) {
  const double theta = w.norm(), t2 = theta * theta;
  const Matrix3d W = skew(w);
  const double c = theta < kSmallAngle
                       ? 1.0 / 12.0 + t2 / 720.0
                       : 1.0 / t2 - std::cos(0.5 * theta) / (2.0 * theta * std::sin(0.5 * theta));
  return Matrix3d::Identity() - 0.5 * W + c * W * W;
}

Vector3d logSO3(const Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  const double n = q.vec().norm();
  if (n < 1e-12) return 2.0 * sign * q.vec();
  return 2.0 * std::atan2(n, sign * q.w()) * sign / n * q.vec();
}

Matrix3d expSO3(const Vector3d& w) {
  const double theta = w.norm();
  if (theta < 1e-12) return Matrix3d::Identity() + skew(w);
  return Eigen::AngleAxisd(theta, w / theta).toRotationMatrix();
}

/** The off-diagonal block Q of the left Jacobian of SE(3) (Barfoot, State Estimation for Robotics,
 * eq. 7.86b), for translation first. */
Matrix3d leftJacobianQ(const Vector3d& rho, const Vector3d& phi) {
  const double t = phi.norm(), t2 = t * t;
  double c1, c2, c3;
  if (t < 0.05) {
    c1 = 1.0 / 6.0 - t2 / 120.0;
    c2 = 1.0 / 24.0 - t2 / 720.0;
    c3 = 1.0 / 120.0 - t2 / 2520.0;
  } else {
    const double s = std::sin(t), c = std::cos(t), t4 = t2 * t2;
    c1 = (t - s) / (t2 * t);
    c2 = (0.5 * t2 + c - 1.0) / t4;
    c3 = (t - 1.5 * s + 0.5 * t * c) / (t4 * t);
  }
  const Matrix3d P = skew(phi), R = skew(rho);
  return 0.5 * R + c1 * (P * R + R * P + P * R * P) +
         c2 * (P * P * R + R * P * P - 3.0 * P * R * P) + c3 * (P * R * P * P + P * P * R * P);
}

}  // namespace

Matrix3d skew(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Pose3 expSE3(const Vector6d& d) {
  Pose3 T = Pose3::Identity();
  T.linear() = expSO3(d.tail<3>());
  T.translation() = leftJacobianSO3(d.tail<3>()) * d.head<3>();
  return T;
}

Vector6d logSE3(const Pose3& T) {
  Vector6d d;
  d.tail<3>() = logSO3(T.linear());
  d.head<3>() = leftJacobianInverseSO3(d.tail<3>()) * T.translation();
  return d;
}

Matrix6d adjoint(const Pose3& T) {
  Matrix6d A = Matrix6d::Zero();
  A.topLeftCorner<3, 3>() = T.linear();
  A.bottomRightCorner<3, 3>() = T.linear();
  A.topRightCorner<3, 3>() = skew(T.translation()) * T.linear();
  return A;
}

Matrix6d rightJacobianInverse(const Vector6d& log) {
  // Jr(x) = Jl(-x); the inverse of [J Q; 0 J] is [J⁻¹ -J⁻¹ Q J⁻¹; 0 J⁻¹].
  const Vector3d rho = -log.head<3>(), phi = -log.tail<3>();
  const Matrix3d J_inv = leftJacobianInverseSO3(phi);
  Matrix6d result = Matrix6d::Zero();
  result.topLeftCorner<3, 3>() = J_inv;
  result.bottomRightCorner<3, 3>() = J_inv;
  result.topRightCorner<3, 3>() = -J_inv * leftJacobianQ(rho, phi) * J_inv;
  return result;
}

Matrix6d composeCovariance(const Matrix6d& a_cov_b, const Pose3& b_T_c, const Matrix6d& b_cov_c) {
  const Matrix6d A = adjoint(b_T_c.inverse());
  return A * a_cov_b * A.transpose() + b_cov_c;
}

Pose3 interpolate(const Pose3& a, const Pose3& b, double ratio) {
  return a * expSE3(ratio * logSE3(a.inverse() * b));
}

double rotationAngle(const Pose3& T) {
  return logSO3(T.linear()).norm();
}

Pose3 planarPose(double x, double y, double yaw) {
  Pose3 T = Pose3::Identity();
  T.linear() = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
  T.translation() << x, y, 0.0;
  return T;
}

double yawOf(const Pose3& T) {
  return std::atan2(T(1, 0), T(0, 0));
}

Pose3 projectToPlane(const Pose3& T) {
  return planarPose(T.translation().x(), T.translation().y(), yawOf(T));
}

Pose3 poseFromYawPitchRoll(const Vector6d& xyz_ypr) {
  Pose3 T = Pose3::Identity();
  T.translation() = xyz_ypr.head<3>();
  T.linear() = (Eigen::AngleAxisd(xyz_ypr[3], Vector3d::UnitZ()) *
                Eigen::AngleAxisd(xyz_ypr[4], Vector3d::UnitY()) *
                Eigen::AngleAxisd(xyz_ypr[5], Vector3d::UnitX()))
                   .toRotationMatrix();
  return T;
}

Vector6d yawPitchRollFromPose(const Pose3& T) {
  Vector6d v;
  v.head<3>() = T.translation();
  v[3] = yawOf(T);
  v[4] = std::atan2(-T(2, 0), std::hypot(T(2, 1), T(2, 2)));
  v[5] = std::atan2(T(2, 1), T(2, 2));
  return v;
}

Pose3 normalized(const Pose3& T) {
  Pose3 result = T;
  result.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return result;
}

bool isFinite(const Pose3& T) {
  return T.matrix().allFinite();
}

bool isCovariance(const Matrix6d& m) {
  if (!m.allFinite()) return false;
  if ((m - m.transpose()).cwiseAbs().maxCoeff() > 1e-6 * m.cwiseAbs().maxCoeff()) return false;
  return m.llt().info() == Eigen::Success;
}

}  // namespace lamp
