#include "lamp/frontend/RelativeCovariance.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace lamp {

namespace {

Matrix6d symmetric(const Matrix6d& m) {
  return 0.5 * (m + m.transpose());
}

/** What differences of large covariances have left below zero is rounding. */
Matrix6d notNegative(const Matrix6d& m) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(symmetric(m));
  const Vector6d values = eigen.eigenvalues().cwiseMax(0.0);
  return eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

void RelativeCovariance::predict(const Pose3& motion, const Matrix6d& covariance) {
  const Matrix6d Ad = adjoint(motion.inverse());
  pose_ = symmetric(Ad * pose_ * Ad.transpose() + covariance);
  cross_ = Ad * cross_;
}

void RelativeCovariance::update(const Matrix6d& information) {
  // (P⁻¹ + I)⁻¹ = (1 + P I)⁻¹ P, which needs no inverse of either.
  const Matrix6d left = (Matrix6d::Identity() + pose_ * information).inverse();
  pose_ = symmetric(left * pose_);
  cross_ = left * cross_;
}

void RelativeCovariance::keep() {
  kept_ = pose_;
  cross_ = pose_;
}

Matrix6d RelativeCovariance::sinceKept(const Pose3& motion) const {
  const Matrix6d B = adjoint(motion.inverse());
  const Matrix6d between = cross_ * B.transpose();
  return notNegative(pose_ + B * kept_ * B.transpose() - between - between.transpose());
}

}  // namespace lamp
