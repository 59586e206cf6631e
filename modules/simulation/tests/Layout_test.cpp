#include "lamp/simulation/Layout.h"

#include <gtest/gtest.h>

#include <cmath>

#include "TestLayout.h"

namespace lamp::simulation {
namespace {

using namespace test;

TEST(Layout, LengthOfAPassageIsThatOfItsLine) {
  Layout layout;
  layout.places = {{0, 0, 0}, {3, 4, 0}};
  addPassage(layout, 0, 1, 3, {{3, 0, 0}});
  EXPECT_DOUBLE_EQ(layout.passages[0].length(), 7);
  EXPECT_DOUBLE_EQ(Passage().length(), 0);
}

TEST(Layout, PassagesAtAPlaceBeginOrEndThere) {
  const Layout layout = ringLayout();
  EXPECT_EQ(layout.passagesAt(0), (std::vector<size_t>{0}));
  EXPECT_EQ(layout.passagesAt(1), (std::vector<size_t>{0, 1, 4}));
  EXPECT_EQ(layout.passagesAt(5), (std::vector<size_t>{5}));
}

TEST(Layout, DistanceToPassagesIsHorizontalAndOnTheSameFloor) {
  Layout layout = deadEndLayout();
  EXPECT_NEAR(layout.distanceToPassages({4, 2.5, 1.0}), 2.5, 1e-12);
  EXPECT_NEAR(layout.distanceToPassages({13, 4, 0}), 5, 1e-12) << "beyond the end";
  EXPECT_TRUE(std::isinf(layout.distanceToPassages({4, 2.5, 5})));
  layout.places.push_back({10, 0, 5});
  layout.places.push_back({0, 0, 5});
  addPassage(layout, 2, 3, 3);
  EXPECT_NEAR(layout.distanceToPassages({4, 2.5, 5}), 2.5, 1e-12) << "the upper floor's";
}

}  // namespace
}  // namespace lamp::simulation
