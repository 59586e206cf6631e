#include "lamp/core/ChiSquare.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lamp {
namespace {

TEST(ChiSquare, QuantilesAreThoseOfTheTables) {
  EXPECT_NEAR(chiSquareQuantile(0.95, 1), 3.841458820694124, 1e-9);
  EXPECT_NEAR(chiSquareQuantile(0.95, 3), 7.814727903251179, 1e-9);
  EXPECT_NEAR(chiSquareQuantile(0.95, 6), 12.591587243743977, 1e-9);
  EXPECT_NEAR(chiSquareQuantile(0.99, 6), 16.811893829770927, 1e-9);
  EXPECT_EQ(chiSquareQuantile(0, 6), 0);
}

TEST(ChiSquare, TwoDegreesHaveAClosedForm) {
  for (const double x : {0.0, 1e-6, 0.1, 1.0, 5.0, 30.0, 200.0})
    EXPECT_NEAR(chiSquareSurvival(x, 2) / std::exp(-x / 2), 1.0, 1e-12) << x;
}

TEST(ChiSquare, QuantileInvertsSurvival) {
  for (const int degrees : {1, 2, 3, 6, 60})
    for (const double probability : {1e-6, 0.01, 0.5, 0.9999, 1 - 1e-12})
      EXPECT_NEAR(chiSquareSurvival(chiSquareQuantile(probability, degrees), degrees),
                  1 - probability, 1e-3 * (1 - probability))
          << degrees << " degrees, " << probability;
}

TEST(ChiSquare, RefusesWhatIsNoProbabilityOrDegree) {
  EXPECT_THROW(chiSquareQuantile(1, 6), std::invalid_argument);
  EXPECT_THROW(chiSquareQuantile(-0.1, 6), std::invalid_argument);
  EXPECT_THROW(chiSquareQuantile(std::nan(""), 6), std::invalid_argument);
  EXPECT_THROW(chiSquareQuantile(0.5, 0), std::invalid_argument);
}

}  // namespace
}  // namespace lamp
