#include "robust/GemanMcClure.h"

#include <gtest/gtest.h>

#include <limits>

namespace lamp {
namespace {

TEST(GemanMcClure, StartsWithNearlyEqualWeights) {
  GemanMcClure loss;
  loss.start(1e4);
  EXPECT_GT(loss.weight(1e4), 0.4);
  EXPECT_NEAR(loss.weight(0.0), 1.0, 1e-12);
}

TEST(GemanMcClure, SharpensToTheRobustCostAndNoFurther) {
  GemanMcClure loss;
  loss.start(1e4);
  EXPECT_FALSE(loss.exactFor({}));
  for (int i = 0; i < 60; ++i) loss.sharpen(1.4);
  EXPECT_TRUE(loss.exactFor({0.9}));
  EXPECT_DOUBLE_EQ(loss.weight(1.0), 0.25);
  EXPECT_DOUBLE_EQ(loss.weight(1e4), 0.0);
}

TEST(GemanMcClure, ResidualThatIsNoNumberIsRejected) {
  EXPECT_DOUBLE_EQ(GemanMcClure().weight(std::numeric_limits<double>::quiet_NaN()), 0.0);
}

}  // namespace
}  // namespace lamp
