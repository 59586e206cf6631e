#include "lamp/evaluation/CovarianceScore.h"

#include <gtest/gtest.h>

#include <random>

namespace lamp::evaluation {
namespace {

/** Errors that are as large as they claim, times a factor. */
std::vector<ClaimedPose> drawn(const Matrix6d& covariance, double factor, int count) {
  std::mt19937 random(1);
  std::normal_distribution<double> unit;
  const Matrix6d L = covariance.llt().matrixL();
  std::vector<ClaimedPose> poses;
  for (int i = 0; i < count; ++i) {
    Vector6d z;
    for (double& value : z) value = factor * unit(random);
    poses.push_back({expSE3(L * z), covariance.inverse()});
  }
  return poses;
}

Matrix6d someCovariance() {
  Matrix6d m = Matrix6d::Identity();
  m(0, 4) = m(4, 0) = 0.7;
  m(1, 2) = m(2, 1) = -0.4;
  return 1e-4 * m;
}

TEST(CovarianceScore, FindsRightOnesRight) {
  const CovarianceScore score = scoreCovariances(drawn(someCovariance(), 1, 20000));
  EXPECT_EQ(score.count, 20000u);
  EXPECT_NEAR(score.beyond_95, 0.05, 0.005);
  for (const auto& variance : score.normalized_variance) EXPECT_NEAR(variance.value(), 1, 0.05);
}

TEST(CovarianceScore, FindsOverconfidence) {
  const CovarianceScore score = scoreCovariances(drawn(someCovariance(), 2, 5000));
  EXPECT_GT(score.beyond_95, 0.5);
  for (const auto& variance : score.normalized_variance) EXPECT_NEAR(variance.value(), 4, 0.4);
}

TEST(CovarianceScore, LeavesOutWhatIsUnknownOrGiven) {
  std::vector<ClaimedPose> poses = drawn(1e-4 * Matrix6d::Identity(), 1, 5000);
  for (ClaimedPose& pose : poses) {
    pose.information(0, 0) = 0;     // the axis of a tunnel
    pose.information(2, 2) = 1e12;  // the height of a robot in the plane
    pose.error.translation().x() += 5;
    pose.error.translation().z() += 1;
  }
  const CovarianceScore score = scoreCovariances(poses);
  EXPECT_FALSE(score.normalized_variance[0]);
  EXPECT_FALSE(score.normalized_variance[2]);
  EXPECT_TRUE(score.normalized_variance[5]);
}

TEST(CovarianceScore, OfNothingIsNothing) {
  EXPECT_EQ(scoreCovariances({}).count, 0u);
  EXPECT_EQ(scoreCovariances({{Pose3::Identity(), Matrix6d::Zero()}}).count, 0u);
}

}  // namespace
}  // namespace lamp::evaluation
