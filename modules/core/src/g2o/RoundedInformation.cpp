#include "g2o/RoundedInformation.h"

#include <Eigen/Eigenvalues>

namespace lamp {

bool mendRounding(Matrix6d& information) {
  // Of a matrix with a unit diagonal: metres and radians differ widely. Rounding to five digits
  // changes each of its entries by 5e-6 at most, and an eigenvalue by six times that.
  constexpr double kLeast = -3e-5, kNone = -1e-12;
  const Vector6d diagonal = information.diagonal();
  if (!information.allFinite() || diagonal.minCoeff() < 0) return false;
  const Vector6d scale = (diagonal.array() > 0).select(diagonal.cwiseSqrt(), 1.0);
  const Vector6d inverse = scale.cwiseInverse();
  const Matrix6d scaled = inverse.asDiagonal() * information * inverse.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(scaled);
  const double least = eigen.eigenvalues().minCoeff();
  if (least >= kNone || least < kLeast) return false;
  const Matrix6d mended = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
                          eigen.eigenvectors().transpose();
  information = scale.asDiagonal() * mended * scale.asDiagonal();
  return true;
}

}  // namespace lamp
