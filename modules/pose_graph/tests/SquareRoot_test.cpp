#include "solver/SquareRoot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lamp {
namespace {

/** A random matrix A·Aᵀ whose axes have scales from 1e-2 to 1e4, in any order: the pivoting of the
 * factorisation then permutes in cycles, too, not in pairs only. */
template <int kSize>
Eigen::Matrix<double, kSize, kSize> randomInformation(std::mt19937& random, int rank) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-1, 2);
  Eigen::Matrix<double, kSize, kSize> a;
  a.setZero();
  for (int column = 0; column < rank; ++column)
    for (int row = 0; row < kSize; ++row) a(row, column) = normal(random);
  Eigen::Matrix<double, kSize, 1> scale;
  for (int i = 0; i < kSize; ++i) scale[i] = std::pow(10.0, exponent(random));
  a = scale.asDiagonal() * a;
  return a * a.transpose();
}

template <int kSize>
void expectRootsOfAll(int rank) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const auto m = randomInformation<kSize>(random, rank);
    const auto root = squareRoot(m);
    ASSERT_LT((root.transpose() * root - m).cwiseAbs().maxCoeff(), 1e-9 * m.cwiseAbs().maxCoeff())
        << m;
  }
}

TEST(SquareRoot, OfFullMatricesGivesThemBack) {
  expectRootsOfAll<3>(3);
  expectRootsOfAll<6>(6);
}

TEST(SquareRoot, OfSingularMatricesGivesThemBack) {
  expectRootsOfAll<3>(2);
  expectRootsOfAll<6>(4);
}

TEST(SquareRoot, KeepsTheInformationOnItsAxis) {
  const Eigen::Vector3d information(280, 277, 9319);
  const Eigen::Matrix3d root = squareRoot(Eigen::Matrix3d(information.asDiagonal()));
  EXPECT_LT((root.transpose() * root - Eigen::Matrix3d(information.asDiagonal())).norm(), 1e-9);
}

}  // namespace
}  // namespace lamp
