#include "lamp/base_station/PlacementVerdict.h"

#include <gtest/gtest.h>

namespace lamp {
namespace {

constexpr int64_t kPatches = 100;

/** Ten pairs of key nodes with 100 patches each, of which those from `from` to `to` contradict. */
Placement placement(int64_t from, int64_t to, int pairs = 10) {
  Placement result;
  for (int k = 0; k < pairs; ++k) {
    ComparedPair pair;
    pair.a = {RobotId{0}, static_cast<uint32_t>(k)};
    pair.b = {RobotId{1}, static_cast<uint32_t>(k)};
    for (int64_t i = 0; i < kPatches; ++i)
      (i >= from && i < to ? pair.of_a.contradicting : pair.of_a.agreeing).push_back({i, 0, 0});
    result.pairs.push_back(pair);
  }
  result.near = pairs;
  return result;
}

/** The same, but nothing is known of patches 0 to 4. */
Placement unaware() {
  Placement result = placement(0, 0);
  for (ComparedPair& pair : result.pairs)
    pair.of_a.agreeing.erase(pair.of_a.agreeing.begin(), pair.of_a.agreeing.begin() + 5);
  return result;
}

TEST(PlacementVerdict, AloneIsBest) {
  const PlacementVerdict verdict = judge({placement(0, 0)});
  EXPECT_EQ(verdict.best, 0u);
  EXPECT_TRUE(verdict.equally_good.empty());
}

TEST(PlacementVerdict, PlacementsWithoutContradictionAreEquallyGoodEvenIfLessOverlaps) {
  const PlacementVerdict verdict = judge({placement(0, 0), placement(0, 0, 6)});
  EXPECT_EQ(verdict.equally_good.size(), 1u);
}

TEST(PlacementVerdict, AStretchOfWallIsNoPlacement) {
  EXPECT_TRUE(judge({placement(0, 0), placement(0, 0, 4)}).equally_good.empty());
}

TEST(PlacementVerdict, ContradictionsRefute) {
  const PlacementVerdict verdict = judge({placement(0, 5), placement(0, 0), placement(3, 30)});
  EXPECT_EQ(verdict.best, 1u) << "whatever place the loop closures proposed";
  EXPECT_TRUE(verdict.equally_good.empty());
}

TEST(PlacementVerdict, NoiseAndWhatIsUsualDoNotRefute) {
  EXPECT_EQ(judge({placement(0, 0), placement(0, 1)}).equally_good.size(), 1u);
  EXPECT_EQ(judge({placement(0, 10), placement(10, 22)}).equally_good.size(), 1u);
}

TEST(PlacementVerdict, WhatRefutedOthersMustBeExplained) {
  std::vector<Placement> placements(4, placement(0, 5));
  placements.push_back(placement(0, 0));
  placements.push_back(unaware());
  const PlacementVerdict verdict = judge(placements);
  EXPECT_EQ(verdict.best, 4u);
  EXPECT_TRUE(verdict.equally_good.empty()) << "it does not know the landmark";
  placements.push_back(placement(0, 0));
  EXPECT_EQ(judge(placements).equally_good.size(), 1u) << "a second landmark like the first";
}

TEST(PlacementVerdict, EvenTheBestMayBeContradicted) {
  EXPECT_FALSE(judge({placement(0, 3), placement(0, 30)}).contradicted);
  const PlacementVerdict verdict = judge({placement(0, 20), placement(0, 60)});
  EXPECT_TRUE(verdict.contradicted);
  EXPECT_NEAR(verdict.contradicting, 0.2, 0.01);
}

TEST(PlacementVerdict, NothingInCommonIsNoReason) {
  EXPECT_TRUE(judge({placement(0, 0, 0)}).equally_good.empty());
}

}  // namespace
}  // namespace lamp
