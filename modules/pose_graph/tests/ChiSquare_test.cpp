#include "lamp/core/ChiSquare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace lamp {
namespace {

struct Row {
  double probability;
  int degrees;
  double x;
};

TEST(ChiSquare, QuantilesOfPrintedTables) {
  // NIST/SEMATECH e-Handbook of Statistical Methods, table 1.3.6.7.4.
  for (const Row& row : {Row{0.90, 1, 2.706}, Row{0.95, 2, 5.991}, Row{0.95, 3, 7.815},
                         Row{0.99, 3, 11.345}, Row{0.999, 3, 16.266}, Row{0.95, 6, 12.592},
                         Row{0.999, 6, 22.458}, Row{0.975, 5, 12.833}, Row{0.99, 100, 135.807}})
    EXPECT_NEAR(chiSquareQuantile(row.probability, row.degrees), row.x, 6e-4)
        << row.probability << ' ' << row.degrees;
}

TEST(ChiSquare, ClosedFormOfTwoDegrees) {
  for (const double p : {0.0, 1e-6, 0.5, 0.9999})
    EXPECT_NEAR(chiSquareQuantile(p, 2), -2.0 * std::log1p(-p), 1e-9);
}

TEST(ChiSquare, SixDegreesAtLampsProbability) {
  // The released LAMP's cost bound of 13.9 is half of it.
  EXPECT_NEAR(chiSquareQuantile(0.9999, 6) / 2, 13.9, 0.05);
}

TEST(ChiSquare, SurvivalIsOneAtZeroAndVanishes) {
  for (const int degrees : {1, 2, 3, 6, 7}) {
    EXPECT_DOUBLE_EQ(chiSquareSurvival(0.0, degrees), 1.0);
    EXPECT_LT(chiSquareSurvival(400.0, degrees), 1e-80);
  }
}

TEST(ChiSquare, RefusesWhatHasNoQuantile) {
  EXPECT_THROW(chiSquareQuantile(1.0, 6), std::invalid_argument);
  EXPECT_THROW(chiSquareQuantile(-0.1, 6), std::invalid_argument);
  EXPECT_THROW(chiSquareQuantile(std::nan(""), 6), std::invalid_argument);
  EXPECT_THROW(chiSquareQuantile(0.5, 0), std::invalid_argument);
}

}  // namespace
}  // namespace lamp
