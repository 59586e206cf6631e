#include "lamp/registration/OverlapResidual.h"

#include <gtest/gtest.h>

#include "TestScans.h"

namespace lamp {
namespace {

using namespace test;

/** A horizontal square patch with one point every 0.1 m, from (x, 0) on, seen from above. */
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
      : target(prepareScan(patch(0, 20, -2), 8, false)),
        source(prepareScan(patch(1.0f, 20, height - 2), 8, false)) {}
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
  EXPECT_NEAR(verification.scores[1].threshold.value(), options.max_residual_m, 1e-6);
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

TEST(OverlapResidual, HonestNoiseIsNoMisfit) {
  constexpr float kNoise_m = 0.1f;
  OverlapResidual verifier;
  verifier.options.max_residual_m = 0.06;
  const auto noisy = prepareScan(roomPoints(3000, kNoise_m, 1), 10, false);
  const auto again = prepareScan(roomPoints(3000, kNoise_m, 2), 10, false);
  const Verification right = verifier.verify({}, *again, *noisy, {});
  EXPECT_GT(right.scores[1].value, verifier.options.max_residual_m)
      << "the noise alone is more than a clean scan may be off";
  EXPECT_TRUE(right.accepted()) << right.refusal;

  const auto clean = prepareScan(roomPoints(3000, 0.005f, 1), 10, false);
  const auto lifted = prepareScan(roomPoints(3000, 0.005f, 2), 10, false);
  RegistrationResult off;
  off.target_T_source.translation() = Eigen::Vector3d(0.15, 0.15, 0.15);
  EXPECT_EQ(verifier.verify(off, *lifted, *clean, {}).refusal, "high residual");
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

TEST(OverlapResidual, AFloorIsNoCeiling) {
  const auto floor = prepareScan(patch(0, 20, -2), 8, false);
  const auto ceiling = prepareScan(patch(0, 20, 2), 8, false);
  OverlapResidual verifier;
  RegistrationResult onto_each_other;
  onto_each_other.target_T_source.translation().z() = 4;
  const Verification verification = verifier.verify(onto_each_other, *floor, *ceiling, {});
  EXPECT_EQ(verification.scores[0].value, 0.0);
  EXPECT_FALSE(verification.accepted());
}

}  // namespace
}  // namespace lamp
