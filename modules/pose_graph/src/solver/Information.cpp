#include "solver/Information.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>

namespace lamp {

namespace {

/** Eigenvalues below this share of the largest count as zero, once the matrix has a unit
 * diagonal. */
constexpr double kNone = 1e-9;
constexpr double kLeastInformation = 1e-6;
constexpr double kOutOfPlaneVariance = 1e-9;

template <class Matrix>
int rank(const Matrix& information) {
  // Values in metres and in radians differ widely.
  const auto scale = information.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse().eval();
  const Matrix scaled = scale.asDiagonal() * information * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(scaled, Eigen::EigenvaluesOnly);
  return static_cast<int>((eigen.eigenvalues().array() > kNone).count());
}

template <class Matrix>
Matrix covarianceOf(const Matrix& information) {
  const Matrix regular = information + kLeastInformation * Matrix::Identity();
  return regular.llt().solve(Matrix::Identity());
}

}  // namespace

Eigen::Matrix3d planarBlock(const Matrix6d& m) {
  Eigen::Matrix3d block;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) block(i, j) = m(kPlanarAxes[i], kPlanarAxes[j]);
  return block;
}

int informationRank(const Matrix6d& information, bool planar) {
  return planar ? rank(planarBlock(information)) : rank(information);
}

Matrix6d boundedCovariance(const Matrix6d& information, bool planar) {
  if (!planar) return covarianceOf(information);
  const Eigen::Matrix3d block = covarianceOf(planarBlock(information));
  Matrix6d covariance = kOutOfPlaneVariance * Matrix6d::Identity();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) covariance(kPlanarAxes[i], kPlanarAxes[j]) = block(i, j);
  return covariance;
}

double mahalanobis2(const Vector6d& error, const Matrix6d& covariance) {
  return error.dot(covariance.llt().solve(error));
}

}  // namespace lamp
