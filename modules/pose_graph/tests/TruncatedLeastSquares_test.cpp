#include "robust/TruncatedLeastSquares.h"

#include <gtest/gtest.h>

#include <limits>

namespace lamp {
namespace {

/** At mu = 0.5: inliers up to 1/3, outliers from 3 on. */
TruncatedLeastSquares half() {
  TruncatedLeastSquares tls;
  tls.start(1.5);
  return tls;
}

TEST(TruncatedLeastSquares, WeightIsContinuousAndFalls) {
  const TruncatedLeastSquares tls = half();
  EXPECT_DOUBLE_EQ(tls.weight(0.0), 1.0);
  EXPECT_NEAR(tls.weight(1.0 / 3.0 + 1e-9), 1.0, 1e-8);
  EXPECT_NEAR(tls.weight(3.0 - 1e-9), 0.0, 1e-8);
  EXPECT_DOUBLE_EQ(tls.weight(3.0 + 1e-9), 0.0);
  double last = 1.0;
  for (double residual2 = 0.4; residual2 < 3.0; residual2 += 0.05) {
    EXPECT_LT(tls.weight(residual2), last);
    last = tls.weight(residual2);
  }
}

TEST(TruncatedLeastSquares, SharpensToAVerdictAtTheThreshold) {
  TruncatedLeastSquares tls = half();
  EXPECT_FALSE(tls.exactFor({0.1, 0.99, 4.0}));
  EXPECT_TRUE(tls.exactFor({0.1, 4.0}));
  for (int i = 0; i < 60; ++i) tls.sharpen(1.4);
  EXPECT_DOUBLE_EQ(tls.weight(0.999), 1.0);
  EXPECT_DOUBLE_EQ(tls.weight(1.001), 0.0);
  EXPECT_TRUE(tls.exactFor({0.1, 0.99, 4.0}));
}

TEST(TruncatedLeastSquares, NothingIsRejectedAtTheStart) {
  TruncatedLeastSquares tls;
  tls.start(1e6);
  EXPECT_GT(tls.weight(0.99e6), 0.0);
  EXPECT_LT(tls.weight(1.0), 1.0);
}

TEST(TruncatedLeastSquares, ResidualThatIsNoNumberIsRejected) {
  EXPECT_DOUBLE_EQ(half().weight(std::numeric_limits<double>::quiet_NaN()), 0.0);
}

}  // namespace
}  // namespace lamp
