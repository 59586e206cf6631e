#include "IcpLinearization.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace lamp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kThickness = 0.01, kKernel_m = 0.3;

struct Pair {
  Vector3d lever, r, n, m;
};

std::vector<Pair> randomPairs() {
  std::vector<Pair> pairs;
  std::srand(7);
  for (int i = 0; i < 20; ++i)
    pairs.push_back({5 * Vector3d::Random(), 0.3 * Vector3d::Random(),
                     Vector3d::Random().normalized(), Vector3d::Random().normalized()});
  for (Pair& pair : pairs)
    if (pair.n.dot(pair.m) < 0) pair.m = -pair.m;
  pairs.back().m.setZero();  // a source point without a normal
  return pairs;
}

/** The residual's weight matrix without the kernel's part, by a plain inverse. */
Matrix3d weightMatrix(const Pair& pair, IcpMetric metric) {
  if (metric == IcpMetric::kPointToPlane) return pair.n * pair.n.transpose();
  const auto covariance = [](const Vector3d& n) -> Matrix3d {
    return Matrix3d::Identity() - (1 - kThickness) * n * n.transpose();
  };
  return 2 * kThickness * (covariance(pair.n) + covariance(pair.m)).inverse();
}

Vector3d residualAfter(const Pair& pair, const Vector6d& motion) {
  return pair.r + expSE3(motion) * pair.lever - pair.lever;
}

/** Half the Geman-McClure cost after a motion about the pivot. */
double halfCost(const std::vector<Pair>& pairs, IcpMetric metric, const Vector6d& motion) {
  const double k2 = kKernel_m * kKernel_m;
  double sum = 0;
  for (const Pair& pair : pairs) {
    const Vector3d r = residualAfter(pair, motion);
    const double s = r.dot(weightMatrix(pair, metric) * r);
    sum += 0.5 * k2 * s / (k2 + s);
  }
  return sum;
}

IcpNormalEquations linearized(const std::vector<Pair>& pairs, IcpMetric metric) {
  Linearization sum(metric, kThickness, kKernel_m);
  for (const Pair& pair : pairs) sum.add(pair.lever, pair.r, pair.n, pair.m);
  return sum.result();
}

Eigen::Matrix<double, 3, 6> jacobian(const Pair& pair) {
  constexpr double kStep = 1e-6;
  Eigen::Matrix<double, 3, 6> J;
  for (int a = 0; a < 6; ++a) {
    const Vector6d d = kStep * Vector6d::Unit(a);
    J.col(a) = (residualAfter(pair, d) - residualAfter(pair, -d)) / (2 * kStep);
  }
  return J;
}

class IcpLinearization : public testing::TestWithParam<IcpMetric> {};
INSTANTIATE_TEST_SUITE_P(All, IcpLinearization,
                         testing::Values(IcpMetric::kPlaneToPlane, IcpMetric::kPointToPlane));

TEST_P(IcpLinearization, GradientIsThatOfTheCost) {
  constexpr double kStep = 1e-6;
  const std::vector<Pair> pairs = randomPairs();
  const IcpNormalEquations equations = linearized(pairs, GetParam());
  for (int a = 0; a < 6; ++a) {
    const Vector6d d = kStep * Vector6d::Unit(a);
    const double slope =
        (halfCost(pairs, GetParam(), d) - halfCost(pairs, GetParam(), -d)) / (2 * kStep);
    EXPECT_NEAR(equations.g[a], slope, 1e-6 * equations.g.norm()) << a;
  }
}

TEST_P(IcpLinearization, TheMatrixIsASumOverNumericalJacobians) {
  const double k2 = kKernel_m * kKernel_m;
  const std::vector<Pair> pairs = randomPairs();
  Matrix6d H = Matrix6d::Zero();
  double weights = 0;
  for (const Pair& pair : pairs) {
    const Matrix3d W = weightMatrix(pair, GetParam());
    const double s = pair.r.dot(W * pair.r), weight = std::pow(k2 / (k2 + s), 2);
    const auto J = jacobian(pair);
    H += weight * J.transpose() * W * J;
    weights += weight;
  }
  const IcpNormalEquations equations = linearized(pairs, GetParam());
  EXPECT_LT((equations.H - H).norm(), 1e-7 * H.norm());
  EXPECT_NEAR(equations.weights, weights, 1e-9);
  EXPECT_EQ(equations.matches, pairs.size());
}

TEST_P(IcpLinearization, SurfacesSeenFromOppositeSidesDoNotMatch) {
  std::vector<Pair> pairs = randomPairs();
  for (Pair& pair : pairs) pair.m = -pair.m;
  EXPECT_EQ(linearized(pairs, GetParam()).matches, 1u) << "the one without a normal";
}

}  // namespace
}  // namespace lamp
