#include "lamp/registration/ObservedPart.h"

#include <Eigen/Eigenvalues>

namespace lamp {

Vector6d observedPart(const Vector6d& motion, const Matrix6d& information) {
  constexpr double kNothing = 1e-9;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(information);
  const double least = kNothing * eigen.eigenvalues()[5];
  Vector6d coordinates = eigen.eigenvectors().transpose() * motion;
  for (int k = 0; k < 6; ++k)
    if (!(eigen.eigenvalues()[k] > least)) coordinates[k] = 0;
  return eigen.eigenvectors() * coordinates;
}

}  // namespace lamp
