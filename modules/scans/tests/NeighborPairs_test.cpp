#include "NeighborPairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "TestRooms.h"

namespace lamp {
namespace {

using Eigen::Vector3f;
using Pairs = std::vector<std::tuple<uint32_t, uint32_t, float>>;

Pairs found(const std::vector<Vector3f>& points, double radius) {
  Pairs pairs;
  for (const NeighborPair& pair : neighborPairs(points, radius))
    pairs.emplace_back(pair.i, pair.j, pair.squared_distance);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Pairs byBruteForce(const std::vector<Vector3f>& points, double radius) {
  const auto squared_radius = static_cast<float>(radius * radius);
  Pairs pairs;
  for (uint32_t i = 0; i < points.size(); ++i)
    for (uint32_t j = i + 1; j < points.size(); ++j) {
      const float squared = (points[j] - points[i]).squaredNorm();
      if (squared > 0 && squared <= squared_radius) pairs.emplace_back(i, j, squared);
    }
  return pairs;
}

TEST(NeighborPairs, AreThoseOfBruteForce) {
  auto points = roomPoints(400, 0.05f, 1);
  points.push_back(points.front());  // equal points are no pair
  for (const float offset : {0.0f, -300.0f, 10000.0f})
    for (const double radius : {0.3, 1.0, 100.0}) {
      std::vector<Vector3f> shifted = points;
      for (auto& p : shifted) p += Vector3f::Constant(offset);
      const Pairs pairs = found(shifted, radius);
      EXPECT_FALSE(pairs.empty());
      EXPECT_EQ(pairs, byBruteForce(shifted, radius)) << offset << " " << radius;
    }
}

TEST(NeighborPairs, OnCellBorders) {
  std::vector<Vector3f> points;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) points.emplace_back(0.7f * x, 0.7f * y, 0.7f * z);
  for (const double radius : {0.7, 0.70001, 1.4})
    EXPECT_EQ(found(points, radius), byBruteForce(points, radius)) << radius;
}

TEST(NeighborPairs, OfCloudsTooWideForTheGridsNumbers) {
  std::vector<Vector3f> points;
  for (const float x : {-9e5f, 0.0f, 9e5f})
    for (int i = 0; i < 20; ++i) points.emplace_back(x + 0.0625f * i, -x, x);
  const Pairs pairs = found(points, 0.1);
  EXPECT_FALSE(pairs.empty());
  EXPECT_EQ(pairs, byBruteForce(points, 0.1));
}

TEST(NeighborPairs, NoneOfFewPoints) {
  EXPECT_TRUE(neighborPairs({}, 1).empty());
  EXPECT_TRUE(neighborPairs({{1, 2, 3}}, 1).empty());
}

}  // namespace
}  // namespace lamp
