#include "lamp/refinement/SharedSurfels.h"

#include <gtest/gtest.h>

#include "lamp/scans/RegistrationInformation.h"

namespace lamp {
namespace {

using Eigen::Vector3d;

/** Two key nodes that see points in planes: `b` at the poses of the world in which the planes are,
 * the other way round disturbed. */
struct TwoViews {
  std::vector<Pose3> truth, poses;
  std::vector<Surfel> surfels;

  explicit TwoViews(const std::vector<Vector3d>& normals, const Vector6d& error) {
    truth = {Pose3(Eigen::Translation3d(1, 2, 3)) *
                 expSE3((Vector6d() << 0, 0, 0, 0.1, 0.2, 0.3).finished()),
             Pose3(Eigen::Translation3d(3, 1, 3)) *
                 expSE3((Vector6d() << 0, 0, 0, 0, -0.1, 1).finished())};
    poses = truth;
    poses[1] = poses[1] * expSE3(error);
    for (uint32_t k = 0; k < normals.size() * 12; ++k) {
      const Vector3d n = normals[k % normals.size()];
      const Vector3d along = n.unitOrthogonal(), across = n.cross(along);
      const double u = 3.0 * std::sin(1.0 * k), v = 3.0 * std::cos(1.7 * k);
      Surfel surfel;
      surfel.key = k;
      surfel.world_normal = n;
      const Vector3d p = 2 * n + u * along + v * across, q = p + 0.3 * along - 0.2 * across;
      surfel.views = {{0, 10, truth[0].inverse() * p}, {1, 10, truth[1].inverse() * q}};
      surfels.push_back(surfel);
    }
  }
  /** Sum of the kernel's costs whose derivative the step takes to zero. */
  double cost(const Vector6d& d) const {
    const Pose3 world_T_b = poses[0] * (poses[0].inverse() * poses[1] * expSE3(d));
    double sum = 0;
    for (const Surfel& surfel : surfels) {
      const double r = surfel.world_normal.dot(world_T_b * surfel.views[1].node_p_mean -
                                               poses[0] * surfel.views[0].node_p_mean);
      sum += r * r * 0.04 / (0.04 + r * r);
    }
    return sum;
  }
};

const std::vector<Vector3d> kAllDirections{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ(),
                                           Vector3d(1, 1, 0.3).normalized()};

TEST(SharedSurfels, OneStepUndoesASmallError) {
  Vector6d error;
  error << 0.02, -0.01, 0.015, 0.004, -0.003, 0.005;
  const TwoViews views(kAllDirections, error);
  const SharedSurfels shared(views.surfels, 2);
  EXPECT_EQ(shared.share(0, 1), 1.0);
  const auto found = shared.registration(0, 1, views.poses);
  const Pose3 left = expSE3(error) * expSE3(found.step);
  EXPECT_LT(logSE3(left).head<3>().norm(), 1e-3);
  EXPECT_LT(logSE3(left).tail<3>().norm(), 2e-4);
}

TEST(SharedSurfels, TheStepIsThatOfTheCostsDerivative) {
  Vector6d error;
  error << 0.03, -0.05, 0.02, 0.01, -0.01, 0.02;
  const TwoViews views(kAllDirections, error);
  const auto found = SharedSurfels(views.surfels, 2).registration(0, 1, views.poses);
  const Pose3 a_T_b = views.poses[0].inverse() * views.poses[1];
  const Matrix6d J = adjoint(Eigen::Translation3d(-found.surface.pivot) * a_T_b);
  Vector6d damping = Vector6d::Constant(1e-3 * found.surface.weights);
  damping.tail<3>() *= found.surface.radius_m * found.surface.radius_m;
  const Matrix6d damped = found.surface.information + Matrix6d(damping.asDiagonal());
  const Vector6d gradient = -2 * J.transpose() * damped * J * found.step;
  for (int k = 0; k < 6; ++k) {
    const Vector6d h = 1e-5 * Vector6d::Unit(k);
    EXPECT_NEAR(gradient[k], (views.cost(h) - views.cost(-h)) / 2e-5, 1e-5 * gradient.norm()) << k;
  }
}

TEST(SharedSurfels, NothingIsKnownAlongACorridor) {
  const TwoViews views({Vector3d::UnitY(), Vector3d::UnitZ()}, Vector6d::Zero());
  const auto found = SharedSurfels(views.surfels, 2).registration(0, 1, views.poses);
  const Pose3 a_T_b = views.poses[0].inverse() * views.poses[1];
  const auto known = registrationInformation(found.surface, a_T_b, {}, false);
  Vector6d along;
  along << views.poses[1].linear().transpose() * Vector3d::UnitX(), Vector3d::Zero();
  EXPECT_LT(along.dot(known.information * along), 1e-6 * known.information.trace());
  EXPECT_GT(known.information.trace(), 100);
}

TEST(SharedSurfels, WhoSharesNothingIsNotMoved) {
  TwoViews views(kAllDirections, Vector6d::Zero());
  for (Surfel& surfel : views.surfels) surfel.views.pop_back();
  const SharedSurfels shared(views.surfels, 2);
  EXPECT_EQ(shared.share(0, 1), 0);
  EXPECT_TRUE(shared.registration(0, 1, views.poses).step.isZero());
}

}  // namespace
}  // namespace lamp
