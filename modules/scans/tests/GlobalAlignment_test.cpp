#include "lamp/scans/GlobalAlignment.h"

#include <gtest/gtest.h>

#include <random>

#include "TestMotions.h"
#include "TestRooms.h"
#include "lamp/scans/SampleConsensus.h"

namespace lamp {
namespace {

using namespace test;

/** A hall of 24 x 16 x 4 m with blocks of all sizes in it, so that no corner is like another. */
std::vector<Eigen::Vector3f> hall(unsigned seed) {
  std::mt19937 layout(11), random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<Eigen::Vector3f> points;
  const auto box = [&](Eigen::Vector3f low, Eigen::Vector3f size) {
    for (int axis = 0; axis < 3; ++axis)
      for (const float side : {0.0f, 1.0f}) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const int count = static_cast<int>(6 * size[u] * size[v]);
        for (int i = 0; i < count; ++i) {
          Eigen::Vector3f p = low;
          p[axis] += side * size[axis];
          p[u] += unit(random) * size[u];
          p[v] += unit(random) * size[v];
          points.push_back(p);
        }
      }
  };
  box({-12, -8, -1}, {24, 16, 4});
  for (int i = 0; i < 10; ++i) {
    const float x = 20 * unit(layout) - 10, y = 12 * unit(layout) - 6;
    if (std::hypot(x, y) < 3) continue;
    box({x, y, -1}, {0.8f + 2 * unit(layout), 0.8f + 2 * unit(layout), 0.8f + 2.5f * unit(layout)});
  }
  return points;
}

struct HallPair {
  explicit HallPair(const Pose3& target_T_source)
      : truth(target_T_source),
        target(prepareScan(hall(1), 10, false)),
        source(prepareScan(moved(hall(2), truth.inverse()), 10, false)) {}
  Pose3 truth;
  PreparedScanPtr target, source;
};

TEST(AlignByConsistency, FindsAnyYawWithoutAGuess) {
  for (const double yaw : {0.0, 1.5, 3.1, -2.0}) {
    const HallPair pair(planarPose(1.0, -0.8, yaw));
    const auto poses =
        alignByConsistency(pair.source->features(), pair.target->features(), std::nullopt, {});
    ASSERT_FALSE(poses.empty()) << yaw;
    const Pose3 error = pair.truth.inverse() * poses.front().target_T_source;
    EXPECT_LT(error.translation().norm(), 0.5) << yaw;
    EXPECT_LT(rotationAngle(error), 4 * kDegree) << yaw;
    EXPECT_GE(poses.front().inliers, 8u);
    EXPECT_GT(poses.front().inlier_ratio, 0.0);
    EXPECT_LE(poses.front().inlier_ratio, 1.0);
  }
}

TEST(AlignByConsistency, BackIsTheInverseOfForth) {
  const HallPair pair(planarPose(1.0, -0.8, 2.0));
  const Features &s = pair.source->features(), &t = pair.target->features();
  const auto forth = alignByConsistency(s, t, std::nullopt, {});
  const auto back = alignByConsistency(t, s, std::nullopt, {});
  ASSERT_FALSE(forth.empty() || back.empty());
  const Pose3 both = forth.front().target_T_source * back.front().target_T_source;
  EXPECT_LT(both.translation().norm(), 0.6);
  EXPECT_LT(rotationAngle(both), 5 * kDegree);
}

TEST(AlignByConsistency, AGuessRulesOutWhatIsTooFarFromIt) {
  const HallPair pair(planarPose(1.0, -0.8, 2.0));
  const UncertainPose right{pair.truth, 1e-2 * Matrix6d::Identity()};
  UncertainPose wrong = right;
  wrong.target_T_source.translation() += Eigen::Vector3d(8, 5, 0);
  const Features &s = pair.source->features(), &t = pair.target->features();
  EXPECT_FALSE(alignByConsistency(s, t, right, {}).empty());
  for (const GlobalPose& pose : alignByConsistency(s, t, wrong, {}))
    EXPECT_GT((pose.target_T_source.translation() - pair.truth.translation()).norm(), 3.0);
}

TEST(AlignByConsistency, UprightTurnsAboutTheVerticalOnly) {
  const HallPair pair(planarPose(1.0, -0.8, 2.0));
  ConsistencyOptions options;
  options.upright = true;
  const auto poses =
      alignByConsistency(pair.source->features(), pair.target->features(), std::nullopt, options);
  ASSERT_FALSE(poses.empty());
  EXPECT_NEAR(poses.front().target_T_source.linear()(2, 2), 1.0, 1e-9);
}

TEST(AlignByConsistency, HasNothingToSayOfTooLittle) {
  const HallPair pair(Pose3::Identity());
  for (const auto& points : std::vector<std::vector<Eigen::Vector3f>>{
           {},
           {{1, 2, 3}},
           {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
           std::vector<Eigen::Vector3f>(100, Eigen::Vector3f(1, 1, 1))}) {
    const auto scan = prepareScan(points, 10, false);
    EXPECT_TRUE(
        alignByConsistency(scan->features(), pair.target->features(), std::nullopt, {}).empty());
    EXPECT_TRUE(
        alignByConsistency(pair.source->features(), scan->features(), std::nullopt, {}).empty());
    EXPECT_FALSE(alignBySamples(scan->features(), *pair.target, {}));
  }
}

TEST(AlignBySamples, FindsTheHallAndRepeatsItself) {
  const HallPair pair(planarPose(1.0, -0.8, 2.0));
  SampleConsensusOptions options;
  options.iterations = 2000;
  const auto pose = alignBySamples(pair.source->features(), *pair.target, options);
  ASSERT_TRUE(pose);
  const Pose3 error = pair.truth.inverse() * pose->target_T_source;
  EXPECT_LT(error.translation().norm(), 1.5);
  EXPECT_LT(rotationAngle(error), 15 * kDegree);
  const auto again = alignBySamples(pair.source->features(), *pair.target, options);
  EXPECT_EQ(again->target_T_source.matrix(), pose->target_T_source.matrix());
}

}  // namespace
}  // namespace lamp
