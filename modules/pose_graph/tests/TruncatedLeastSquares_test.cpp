#include "TruncatedLeastSquares.h"

#include <gtest/gtest.h>

#include <limits>

namespace lamp {
namespace {

constexpr TruncatedLeastSquares kTls{9.0};

TEST(TruncatedLeastSquares, WeightIsContinuousAndFalls) {
  const double mu = 0.5;
  EXPECT_DOUBLE_EQ(kTls.inlierLimit(mu), 3.0);
  EXPECT_DOUBLE_EQ(kTls.outlierLimit(mu), 27.0);
  EXPECT_DOUBLE_EQ(kTls.weight(0.0, mu), 1.0);
  EXPECT_NEAR(kTls.weight(3.0 + 1e-9, mu), 1.0, 1e-8);
  EXPECT_NEAR(kTls.weight(27.0 - 1e-9, mu), 0.0, 1e-8);
  EXPECT_DOUBLE_EQ(kTls.weight(27.0, mu), 0.0);
  double last = 1.0;
  for (double chi2 = 3.5; chi2 < 27.0; chi2 += 0.5) {
    EXPECT_LT(kTls.weight(chi2, mu), last);
    last = kTls.weight(chi2, mu);
  }
}

TEST(TruncatedLeastSquares, LargeMuDecidesAtTheThreshold) {
  EXPECT_DOUBLE_EQ(kTls.weight(8.99, 1e6), 1.0);
  EXPECT_DOUBLE_EQ(kTls.weight(9.01, 1e6), 0.0);
}

TEST(TruncatedLeastSquares, NothingIsRejectedAtTheStart) {
  const double mu = kTls.initialMu(1e6);
  EXPECT_GT(mu, 0.0);
  EXPECT_GT(kTls.weight(1e6, mu), 0.0);
  EXPECT_LT(kTls.inlierLimit(mu), 1e-4);
}

TEST(TruncatedLeastSquares, ResidualThatIsNoNumberIsRejected) {
  EXPECT_DOUBLE_EQ(kTls.weight(std::numeric_limits<double>::quiet_NaN(), 0.5), 0.0);
}

}  // namespace
}  // namespace lamp
