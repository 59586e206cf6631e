#include "lamp/scans/Observability.h"

#include <Eigen/Eigenvalues>

namespace lamp {

namespace {

using Eigen::Matrix3d;

/** What is left of the first block's information when the second one's motion is free: the Schur
 * complement, with a pseudo-inverse where the second one is not observed either. */
Matrix3d marginal(const Matrix3d& first, const Matrix3d& between, const Matrix3d& second) {
  constexpr double kNothing = 1e-9;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(second);
  const double least = kNothing * std::max(second.trace(), 1e-300);
  const Eigen::Vector3d inverse = eigen.eigenvalues().unaryExpr(
      [least](double value) { return value > least ? 1.0 / value : 0.0; });
  return first - between * eigen.eigenvectors() * inverse.asDiagonal() *
                     eigen.eigenvectors().transpose() * between.transpose();
}

}  // namespace

Observability observability(const Matrix6d& information, double points, double radius_m) {
  Observability result;
  if (!(points > 0) || !(radius_m > 0)) return result;
  const Matrix3d tt = information.topLeftCorner<3, 3>() / points;
  const Matrix3d tr = information.topRightCorner<3, 3>() / (points * radius_m);
  const Matrix3d rr = information.bottomRightCorner<3, 3>() / (points * radius_m * radius_m);
  const Eigen::SelfAdjointEigenSolver<Matrix3d> translation(marginal(tt, tr, rr));
  const Eigen::SelfAdjointEigenSolver<Matrix3d> rotation(marginal(rr, tr.transpose(), tt));
  result.translation = translation.eigenvalues().cwiseMax(0.0);
  result.translations = translation.eigenvectors();
  result.rotation = rotation.eigenvalues().cwiseMax(0.0);
  result.rotations = rotation.eigenvectors();
  return result;
}

}  // namespace lamp
