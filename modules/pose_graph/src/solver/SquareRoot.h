#pragma once

#include <Eigen/Cholesky>

namespace lamp {

/** A square root S of a positive semi-definite matrix: m = Sᵀ S. The matrix may be singular. */
template <class Matrix>
Matrix squareRoot(const Matrix& m) {
  // m = Pᵀ L D Lᵀ P. P is applied from the left: from the right, Eigen's transpositions act as
  // their inverse.
  const Eigen::LDLT<Matrix> ldlt(m);
  const Matrix permutation = ldlt.transpositionsP() * Matrix::Identity();
  const Matrix upper = ldlt.matrixU();
  return ldlt.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal() * (upper * permutation);
}

}  // namespace lamp
