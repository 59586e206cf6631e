#include "lamp/core/KdTree.h"

#include <gtest/gtest.h>

#include <cmath>

#include "TestRooms.h"

namespace lamp {
namespace {

TEST(KdTree, FindsWhatBruteForceFinds) {
  const auto points = roomPoints(500, 0.1f, 3);
  const auto queries = roomPoints(100, 1.0f, 4);
  const KdTree tree(points);
  for (const auto& query : queries) {
    size_t best = 0;
    for (size_t i = 1; i < points.size(); ++i)
      if ((points[i] - query).squaredNorm() < (points[best] - query).squaredNorm()) best = i;
    const float distance = (points[best] - query).norm();
    float squared = -1;
    EXPECT_EQ(tree.nearest(query, distance * 1.01f, squared), best);
    EXPECT_NEAR(std::sqrt(squared), distance, 1e-5);
    EXPECT_EQ(tree.nearest(query, distance * 0.99f, squared), KdTree::kNone);
  }
}

}  // namespace
}  // namespace lamp
