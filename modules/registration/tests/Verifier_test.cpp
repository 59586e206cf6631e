#include "lamp/registration/Verifier.h"

#include <gtest/gtest.h>

#include "TestScans.h"
#include "lamp/core/ChiSquare.h"

namespace lamp {
namespace {

using namespace test;

/** A horizontal square patch with one point every 0.1 m, from (x, 0) on. */
Points patch(float x, int columns, float z) {
  Points points;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < 20; ++j)
      points.emplace_back(x + 0.1f * static_cast<float>(i), 0.1f * static_cast<float>(j), z);
  return points;
}

/** A source of which exactly half lies on the target, `height` above it. */
struct HalfOverlap {
  explicit HalfOverlap(float height)
      : target(prepareScan(patch(0, 20, 0), 8, false)),
        source(prepareScan(patch(1.0f, 20, height), 8, false)) {}
  PreparedScanPtr target, source;
};

Verification verify(const OverlapResidualOptions& options, const HalfOverlap& scans) {
  OverlapResidual verifier;
  verifier.options = options;
  return verifier.verify({}, *scans.source, *scans.target, {});
}

TEST(OverlapResidual, MeasuresOverlapAndResidual) {
  OverlapResidualOptions options;
  options.partner_distance_m = 0.06;
  const Verification verification = verify(options, HalfOverlap(0.05f));
  ASSERT_EQ(verification.scores.size(), 2u);
  EXPECT_EQ(verification.scores[0].name, "overlap");
  EXPECT_NEAR(verification.scores[0].value, 0.5, 1e-9);
  EXPECT_EQ(verification.scores[0].threshold, options.min_overlap);
  EXPECT_EQ(verification.scores[1].name, "residual_m");
  EXPECT_NEAR(verification.scores[1].value, 0.05, 1e-6);
  EXPECT_EQ(verification.scores[1].threshold, options.max_residual_m);
}

TEST(OverlapResidual, RefusesLittleOverlapFromTheThresholdOn) {
  const HalfOverlap scans(0.0f);
  OverlapResidualOptions options;
  options.partner_distance_m = 0.06;
  options.min_overlap = 0.5;
  EXPECT_TRUE(verify(options, scans).accepted()) << "the limit itself is enough";
  options.min_overlap = 0.501;
  EXPECT_EQ(verify(options, scans).refusal, "low overlap");
}

TEST(OverlapResidual, RefusesALargeResidualFromTheThresholdOn) {
  const HalfOverlap scans(0.05f);
  OverlapResidualOptions options;
  options.partner_distance_m = 0.06;
  options.min_overlap = 0.4;
  options.max_residual_m = 0.051;
  EXPECT_TRUE(verify(options, scans).accepted());
  options.max_residual_m = 0.049;
  EXPECT_EQ(verify(options, scans).refusal, "high residual");
}

TEST(OverlapResidual, LooksForPartnersWithinItsDistanceOnly) {
  OverlapResidualOptions options;
  options.partner_distance_m = 0.04;
  EXPECT_EQ(verify(options, HalfOverlap(0.05f)).scores[0].value, 0.0);
}

TEST(OverlapResidual, RefusesAnEmptySource) {
  const auto empty = prepareScan({}, 8, false);
  const HalfOverlap scans(0);
  EXPECT_FALSE(OverlapResidual{}.verify({}, *empty, *scans.target, {}).accepted());
  EXPECT_FALSE(OverlapResidual{}.verify({}, *scans.source, *empty, {}).accepted());
}

/** GuessDeviation on scans that it does not look at. */
class GuessDeviationTest : public testing::Test {
 protected:
  Verification verify(const Pose3& result_pose, const Guess& guess, bool planar = false) const {
    RegistrationResult result;
    result.target_T_source = result_pose;
    result.covariance = result_covariance;
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
  Matrix6d result_covariance = 0.01 * Matrix6d::Identity();
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
  ASSERT_EQ(verification.scores.size(), 1u);
  EXPECT_EQ(verification.scores[0].name, "guess_chi2");
  EXPECT_NEAR(verification.scores[0].value, 1.44 / (0.25 + 0.01 + 0.16), 1e-9);
  EXPECT_NEAR(*verification.scores[0].threshold, chiSquareQuantile(0.9999, 6), 1e-12);
  const double turned = 0.3;
  EXPECT_NEAR(
      verify(T * expSE3(tangent(0, 0, 0, 0, 0, turned)), guess(T, 0.5, 0.1)).scores[0].value,
      turned * turned / (0.01 + 0.01 + std::pow(6 * kDegree, 2)), 1e-9);
}

TEST_F(GuessDeviationTest, RefusesBeyondTheQuantile) {
  // All variances on x sum to one, so that the limit is the root of the quantile.
  verifier.options.slack_m = 0.3;
  const double sigma = std::sqrt(1.0 - 0.01 - 0.09);
  for (const bool planar : {false, true}) {
    const double limit = std::sqrt(chiSquareQuantile(0.9999, planar ? 3 : 6));
    const auto at = [&](double distance) {
      return verify(T * planarPose(distance, 0, 0), guess(T, sigma, 0.1), planar);
    };
    EXPECT_TRUE(at(limit - 0.01).accepted());
    EXPECT_EQ(at(limit + 0.01).refusal, "far from the guess");
  }
}

TEST_F(GuessDeviationTest, ALessCertainGuessLetsMoreThrough) {
  const Pose3 result = T * planarPose(4, 0, 0.5);
  EXPECT_FALSE(verify(result, guess(T, 0.1, 0.02)).accepted());
  EXPECT_TRUE(verify(result, guess(T, 2.0, 0.3)).accepted());
}

TEST_F(GuessDeviationTest, SlackKeepsAnOverconfidentGraphFromRefusingEverything) {
  result_covariance = 1e-12 * Matrix6d::Identity();
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

}  // namespace
}  // namespace lamp
