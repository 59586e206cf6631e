#include "lamp/scans/RobustPose.h"

#include <gtest/gtest.h>

#include <random>

#include "TestMotions.h"

namespace lamp {
namespace {

using namespace test;

/** Pairs of which a share is wrong, the others off by up to 5 mm in each coordinate. */
std::vector<PointPair> pairsOf(const Pose3& target_T_source, size_t count, double outliers,
                               unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-10, 10), noise(-0.005, 0.005);
  const auto vector = [&](auto& distribution) {
    return Eigen::Vector3d(distribution(random), distribution(random), distribution(random));
  };
  std::vector<PointPair> pairs(count);
  for (size_t i = 0; i < count; ++i) {
    pairs[i].source = vector(place);
    pairs[i].target = static_cast<double>(i) < outliers * static_cast<double>(count)
                          ? vector(place)
                          : Eigen::Vector3d(target_T_source * pairs[i].source + vector(noise));
  }
  std::shuffle(pairs.begin(), pairs.end(), random);
  return pairs;
}

class Outliers : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Shares, Outliers, testing::Values(0.0, 0.2, 0.5, 0.8));

TEST_P(Outliers, DoNotMoveThePose) {
  const Pose3 truth = expSE3(tangent(3, -2, 1, 0.4, -0.8, 2.5));
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto pose = robustPose(pairsOf(truth, 150, GetParam(), seed), 0.05, false);
    ASSERT_TRUE(pose);
    const Pose3 error = truth.inverse() * *pose;
    EXPECT_LT(error.translation().norm(), 0.02) << seed;
    EXPECT_LT(rotationAngle(error), 0.1 * kDegree) << seed;
  }
}

TEST_P(Outliers, DoNotMoveAnUprightPose) {
  const Pose3 truth = Pose3(Eigen::Translation3d(0, 0, 2)) * planarPose(5, -3, 2.0);
  const auto pose = robustPose(pairsOf(truth, 150, GetParam(), 7), 0.05, true);
  ASSERT_TRUE(pose);
  EXPECT_LT((truth.inverse() * *pose).translation().norm(), 0.02);
  EXPECT_NEAR(pose->linear()(2, 2), 1.0, 1e-12);
}

TEST(RobustPose, LeastSquaresIsExactWithoutNoise) {
  const Pose3 truth = expSE3(tangent(3, -2, 1, 0.4, -0.8, 2.5));
  std::vector<PointPair> pairs;
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 2, 0), Eigen::Vector3d(0, 0, 3)})
    pairs.push_back({p, truth * p});
  EXPECT_LT((leastSquaresPose(pairs, false).matrix() - truth.matrix()).norm(), 1e-12);
}

TEST(RobustPose, IsNoneOfTooFewPairs) {
  const auto pairs = pairsOf(Pose3::Identity(), 2, 0, 1);
  EXPECT_FALSE(robustPose(pairs, 0.05, false));
  EXPECT_FALSE(robustPose({}, 0.05, false));
}

TEST(RobustPose, AnInverseOfTheDataGivesTheInverse) {
  const Pose3 truth = expSE3(tangent(3, -2, 1, 0.4, -0.8, 2.5));
  auto pairs = pairsOf(truth, 100, 0.5, 3);
  const auto forth = robustPose(pairs, 0.05, false);
  for (PointPair& pair : pairs) std::swap(pair.source, pair.target);
  const auto back = robustPose(pairs, 0.05, false);
  ASSERT_TRUE(forth && back);
  EXPECT_LT(logSE3(*forth * *back).norm(), 0.02);
}

TEST(AdaptiveVote, TakesTheMeanOfTheFullestInterval) {
  EXPECT_DOUBLE_EQ(adaptiveVote({9, 1.0, 5, 1.2, 1.1, 7, -4}, 0.1), 1.1);
  EXPECT_DOUBLE_EQ(adaptiveVote({3}, 0.1), 3);
}

}  // namespace
}  // namespace lamp
