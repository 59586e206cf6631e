#include "lamp/scans/Observability.h"

#include <gtest/gtest.h>

#include <random>

namespace lamp {
namespace {

/** Observability of points with normals about the origin. */
template <class Sample>
Observability of(const Sample& sample) {
  std::mt19937 random(1);
  Matrix6d A = Matrix6d::Zero();
  double squares = 0;
  constexpr int kPoints = 20000;
  for (int i = 0; i < kPoints; ++i) {
    const auto [point, normal] = sample(random);
    Vector6d h;
    h << normal, point.cross(normal);
    A += h * h.transpose();
    squares += point.squaredNorm();
  }
  return observability(A, kPoints, std::sqrt(squares / kPoints));
}

using Sampled = std::pair<Eigen::Vector3d, Eigen::Vector3d>;

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

TEST(Observability, OfASphereIsAThirdForEachTranslationAndNoneForRotations) {
  const Observability sphere = of([](std::mt19937& random) {
    std::normal_distribution<double> normal;
    const Eigen::Vector3d n =
        Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    return Sampled(2 * n, n);
  });
  EXPECT_LT((sphere.translation.array() - 1.0 / 3).abs().maxCoeff(), 0.02);
  EXPECT_LT(sphere.rotation.maxCoeff(), 1e-12);
}

TEST(Observability, OfARoundTunnelIsNoneAlongAndAboutItsAxis) {
  const Observability tunnel = of([](std::mt19937& random) {
    const double a = uniform(random, -M_PI, M_PI);
    const Eigen::Vector3d n(0, std::cos(a), std::sin(a));
    return Sampled(2 * n + uniform(random, -10, 10) * Eigen::Vector3d::UnitX(), n);
  });
  EXPECT_NEAR(tunnel.translation[0], 0, 1e-9);
  EXPECT_NEAR(std::abs(tunnel.translations(0, 0)), 1, 1e-6);
  EXPECT_NEAR(tunnel.translation[1], 0.5, 0.02);
  EXPECT_NEAR(tunnel.rotation[0], 0, 1e-9);
  EXPECT_NEAR(std::abs(tunnel.rotations(0, 0)), 1, 1e-6);
  EXPECT_GT(tunnel.rotation[1], 0.3);
}

TEST(Observability, OfAPlaneIsItsHeightAndTilt) {
  const Observability plane = of([](std::mt19937& random) {
    return Sampled({uniform(random, -3, 3), uniform(random, -3, 3), 0}, Eigen::Vector3d::UnitZ());
  });
  EXPECT_NEAR(plane.translation[1], 0, 1e-9);
  EXPECT_NEAR(plane.translation[2], 1, 1e-3);
  EXPECT_NEAR(plane.rotation[0], 0, 1e-9);
  EXPECT_NEAR(plane.rotation[1], 0.5, 0.02);
}

TEST(Observability, OfNothingIsNone) {
  EXPECT_TRUE(observability(Matrix6d::Zero(), 0, 0).translation.isZero());
  EXPECT_TRUE(observability(Matrix6d::Zero(), 10, 1).translation.isZero());
}

}  // namespace
}  // namespace lamp
