#include "solver/PoseSpaces.h"

#include <gtest/gtest.h>

#include "NumericJacobian.h"
#include "TestGraphs.h"

namespace lamp {
namespace {

template <class Space>
typename Space::Pose randomPose(Random& random, double range_rad) {
  return Space::fromPose3(random.pose(5.0, range_rad, Space::kDof == 3));
}

template <class Space>
class PoseSpaces : public testing::Test {};
using Spaces = testing::Types<Se2, Se3>;
TYPED_TEST_SUITE(PoseSpaces, Spaces);

TYPED_TEST(PoseSpaces, RelativeJacobiansMatchFiniteDifferences) {
  using Space = TypeParam;
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const auto measured = randomPose<Space>(random, 1.2), from = randomPose<Space>(random, 1.5),
               to = randomPose<Space>(random, 1.5);
    typename Space::Jacobian d_from, d_to;
    const auto error = Space::relativeError(measured, from, to, &d_from, &d_to);
    if (error.template tail<1>().norm() > 3.0) continue;  // Log jumps at pi
    const auto numeric_from = numericJacobian<Space>(from, [&](const auto& p) {
      return Space::relativeError(measured, p, to, nullptr, nullptr);
    });
    const auto numeric_to = numericJacobian<Space>(to, [&](const auto& p) {
      return Space::relativeError(measured, from, p, nullptr, nullptr);
    });
    EXPECT_LT((d_from - numeric_from).cwiseAbs().maxCoeff(), 1e-6 * (1 + d_from.norm()));
    EXPECT_LT((d_to - numeric_to).cwiseAbs().maxCoeff(), 1e-6 * (1 + d_to.norm()));
  }
}

TYPED_TEST(PoseSpaces, PriorJacobianMatchesFiniteDifferences) {
  using Space = TypeParam;
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const auto measured = randomPose<Space>(random, 0.7), pose = randomPose<Space>(random, 0.7);
    typename Space::Jacobian d_pose;
    Space::priorError(measured, pose, &d_pose);
    const auto numeric = numericJacobian<Space>(
        pose, [&](const auto& p) { return Space::priorError(measured, p, nullptr); });
    EXPECT_LT((d_pose - numeric).cwiseAbs().maxCoeff(), 1e-6 * (1 + d_pose.norm()));
  }
}

TYPED_TEST(PoseSpaces, MinusInvertsPlus) {
  using Space = TypeParam;
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const auto a = randomPose<Space>(random, 1.7), b = randomPose<Space>(random, 1.7);
    const Pose3 back = Space::toPose3(Space::plus(a, Space::minus(b, a)));
    EXPECT_TRUE(back.isApprox(Space::toPose3(b), 1e-12));
  }
}

TYPED_TEST(PoseSpaces, BlocksKeepPoses) {
  using Space = TypeParam;
  Random random(4);
  const auto pose = randomPose<Space>(random, 1.7);
  double block[Space::kSize];
  Space::store(pose, block);
  EXPECT_TRUE(Space::toPose3(Space::load(block)).isApprox(Space::toPose3(pose), 1e-14));
}

TEST(PoseSpaces2, ErrorIsThePlanarPartOfTheLogarithmToFirstOrder) {
  Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const Pose3 measured = random.pose(5.0, 3.0, true), from = random.pose(5.0, 3.0, true);
    const Pose3 small = random.pose(1e-4, 1e-4, true);
    const Vector6d log = logSE3(small);
    const Eigen::Vector3d error =
        Se2::relativeError(Se2::fromPose3(measured), Se2::fromPose3(from),
                           Se2::fromPose3(from * measured * small), nullptr, nullptr);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(error[i], log[kPlanarAxes[i]], 1e-8);
  }
}

TEST(PoseSpaces2, YawErrorIsWrapped) {
  const Eigen::Vector3d error =
      Se2::relativeError({1, 0, 3.1}, {0, 0, 0}, {1, 0, -3.1}, nullptr, nullptr);
  EXPECT_NEAR(error.z(), 2 * M_PI - 6.2, 1e-12);
}

}  // namespace
}  // namespace lamp
