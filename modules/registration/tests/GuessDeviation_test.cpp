#include "lamp/registration/GuessDeviation.h"

#include <gtest/gtest.h>

#include "TestScans.h"
#include "lamp/core/ChiSquare.h"

namespace lamp {
namespace {

using namespace test;

/** GuessDeviation on scans that it does not look at. */
class GuessDeviationTest : public testing::Test {
 protected:
  Verification verify(const Pose3& result_pose, const Guess& guess, bool planar = false) const {
    RegistrationResult result;
    result.target_T_source = result_pose;
    result.information = result_information;
    result.unobserved = unobserved;
    const auto scan = prepareScan({}, 3, planar);
    return verifier.verify(result, *scan, *scan, guess);
  }

  static Guess guess(const Pose3& T, double sigma_m, double sigma_rad) {
    Vector6d variances;
    variances.head<3>().setConstant(sigma_m * sigma_m);
    variances.tail<3>().setConstant(sigma_rad * sigma_rad);
    return {T, Matrix6d(variances.asDiagonal())};
  }

  GuessDeviation verifier;
  Matrix6d result_information = 100 * Matrix6d::Identity();
  std::vector<std::string> unobserved;
  const Pose3 T = expSE3(tangent(2, 1, 0.5, 0.1, 0.2, 1.5));
};

TEST_F(GuessDeviationTest, HasNothingToSayWithoutACovariance) {
  const Verification verification = verify(T * planarPose(50, 0, 2), {T, std::nullopt});
  EXPECT_TRUE(verification.accepted());
  EXPECT_TRUE(verification.scores.empty());
}

TEST_F(GuessDeviationTest, ScoreIsTheMahalanobisDistanceWithAllThreeVariances) {
  verifier.options.slack_m = 0.4;
  verifier.options.slack_deg = 6;
  const Verification verification =
      verify(T * expSE3(tangent(0, 1.2, 0, 0, 0, 0)), guess(T, 0.5, 0.1));
  ASSERT_EQ(verification.scores.size(), 2u);
  EXPECT_EQ(verification.scores[0].name, "guess_chi2");
  EXPECT_NEAR(verification.scores[0].value, 1.44 / (0.25 + 0.01 + 0.16), 1e-9);
  EXPECT_NEAR(*verification.scores[0].threshold, chiSquareQuantile(verifier.options.probability, 6),
              1e-12);
  EXPECT_EQ(verification.scores[1].name, "guess_position_chi2");
  EXPECT_NEAR(verification.scores[1].value, verification.scores[0].value, 1e-9) << "not turned";
  EXPECT_NEAR(*verification.scores[1].threshold, chiSquareQuantile(verifier.options.probability, 3),
              1e-12);
  const double turned = 0.3;
  EXPECT_NEAR(
      verify(T * expSE3(tangent(0, 0, 0, 0, 0, turned)), guess(T, 0.5, 0.1)).scores[0].value,
      turned * turned / (0.01 + 0.01 + std::pow(6 * kDegree, 2)), 1e-9);
}

TEST_F(GuessDeviationTest, RefusesBeyondTheQuantile) {
  // All variances on x sum to one, so that the limit is the root of the quantile of the position.
  verifier.options.slack_m = 0.3;
  const double sigma = std::sqrt(1.0 - 0.01 - 0.09);
  for (const bool planar : {false, true}) {
    const double limit = std::sqrt(chiSquareQuantile(verifier.options.probability, planar ? 2 : 3));
    const auto at = [&](double distance) {
      return verify(T * planarPose(distance, 0, 0), guess(T, sigma, 0.1), planar);
    };
    EXPECT_TRUE(at(limit - 0.01).accepted());
    EXPECT_EQ(at(limit + 0.01).refusal, "far from the guess");
  }
}

TEST_F(GuessDeviationTest, PositionIsNotExcusedByTheRotation) {
  // Together within the quantile of six directions; the shift alone is beyond that of three.
  const Vector6d shift = tangent(0, 0, 3.6, 0, 0, 0);
  const Verification verification = verify(T * expSE3(shift), guess(T, std::sqrt(0.74), 0.1));
  EXPECT_LT(verification.scores[0].value, *verification.scores[0].threshold);
  EXPECT_EQ(verification.refusal, "far from the guess");
}

TEST_F(GuessDeviationTest, PositionThatIsUncertainBecauseTheRotationIs) {
  // A guess that is wrong in yaw puts a place 20 m ahead aside: the covariance says so.
  Guess far = guess(T, 0.1, 0.02);
  const Pose3 lever = Pose3(Eigen::Translation3d(20, 0, 0));
  const Matrix6d J = adjoint(lever.inverse());
  far.covariance = J * *far.covariance * J.transpose();
  far.target_T_source = T * lever;
  const Pose3 result = T * expSE3(tangent(0, 0, 0, 0, 0, 0.04)) * lever;
  EXPECT_TRUE(verify(result, far).accepted());
  EXPECT_FALSE(verify(far.target_T_source * planarPose(2.5, 0, 0), far).accepted())
      << "the same distance ahead";
}

TEST_F(GuessDeviationTest, ALessCertainGuessLetsMoreThrough) {
  const Pose3 result = T * planarPose(4, 0, 0.5);
  EXPECT_FALSE(verify(result, guess(T, 0.1, 0.02)).accepted());
  EXPECT_TRUE(verify(result, guess(T, 2.0, 0.3)).accepted());
}

TEST_F(GuessDeviationTest, SlackKeepsAnOverconfidentGraphFromRefusingEverything) {
  result_information = 1e12 * Matrix6d::Identity();
  const Pose3 result = T * planarPose(0.4, 0, 5 * kDegree);
  const Guess certain = guess(T, 1e-6, 1e-6);
  EXPECT_TRUE(verify(result, certain).accepted());
  verifier.options.slack_m = 0.01;
  verifier.options.slack_deg = 0.1;
  EXPECT_FALSE(verify(result, certain).accepted());
}

TEST_F(GuessDeviationTest, FollowsTheDirectionOfTheUncertainty) {
  Guess along_x{T, Matrix6d(1e-4 * Matrix6d::Identity())};
  (*along_x.covariance)(0, 0) = 9;
  EXPECT_TRUE(verify(T * planarPose(6, 0, 0), along_x).accepted());
  EXPECT_FALSE(verify(T * planarPose(0, 6, 0), along_x).accepted());
}

TEST_F(GuessDeviationTest, WhatTheResultDoesNotKnowIsNoDeviation) {
  const Pose3 slid = T * planarPose(20, 0, 0);
  EXPECT_FALSE(verify(slid, guess(T, 0.5, 0.1)).accepted());
  result_information(0, 0) = 0;
  EXPECT_TRUE(verify(slid, guess(T, 0.5, 0.1)).accepted());
  EXPECT_FALSE(verify(T * planarPose(20, 20, 0), guess(T, 0.5, 0.1)).accepted());
  unobserved = {"translation along x"};
  EXPECT_NEAR(*verify(slid, guess(T, 0.5, 0.1)).scores[0].threshold,
              chiSquareQuantile(verifier.options.probability, 5), 1e-12);
}

}  // namespace
}  // namespace lamp
