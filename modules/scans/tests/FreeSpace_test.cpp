#include "lamp/scans/FreeSpace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "OctahedralMap.h"

namespace lamp {
namespace {

using Eigen::Vector3f;
using Place = FreeSpace::Place;

constexpr float kMargin_m = 0.3f;

/** A wall at x = 5, every 5 cm, seen from the given places in turn. */
Cloud wall(const std::vector<Vector3f>& viewpoints) {
  Cloud cloud;
  cloud.viewpoints = viewpoints;
  cloud.own_viewpoints = viewpoints.size();
  for (uint32_t view = 0; view < viewpoints.size(); ++view)
    for (int y = -80; y <= 80; ++y)
      for (int z = -40; z <= 40; ++z) {
        cloud.points.emplace_back(5, 0.05f * y, 0.05f * z);
        cloud.viewpoint.push_back(view);
      }
  return cloud;
}

TEST(FreeSpace, BeforeOnAndBehindAWall) {
  const FreeSpace space(wall({{0, 0, 0}}));
  EXPECT_EQ(space.at({2, 0.1f, 0}, kMargin_m), Place::kFree);
  EXPECT_EQ(space.at({5, 1, 0.5f}, kMargin_m), Place::kSurface);
  EXPECT_EQ(space.at({4.8f, 0, 0}, kMargin_m), Place::kSurface);
  EXPECT_EQ(space.at({7, 0, 0}, kMargin_m), Place::kUnknown);
  EXPECT_EQ(space.at({-2, 0, 0}, kMargin_m), Place::kUnknown);
}

TEST(FreeSpace, AnyViewpointMayHaveSeenThrough) {
  const FreeSpace one(wall({{0, 0, 0}})), both(wall({{0, 0, 0}, {10, 0, 0}}));
  EXPECT_EQ(one.at({8, 0, 0}, kMargin_m), Place::kUnknown);
  EXPECT_EQ(both.at({8, 0, 0}, kMargin_m), Place::kFree);
  EXPECT_EQ(both.at({2, 0, 0}, kMargin_m), Place::kFree);
  EXPECT_EQ(both.at({5, 0, 0}, kMargin_m), Place::kSurface);
}

TEST(FreeSpace, AFloorDoesNotCallItsOwnPointsFree) {
  Cloud floor;
  floor.viewpoints = {{0, 0, 1}, {6, 2, 0.7f}};
  for (int x = -60; x <= 60; ++x)
    for (int y = -60; y <= 60; ++y) {
      floor.points.emplace_back(0.25f * x, 0.25f * y, 0.0f);
      floor.viewpoint.push_back(static_cast<uint32_t>(x + y) % 2);
    }
  const FreeSpace space(floor);
  size_t free = 0;
  for (const Vector3f& p : floor.points) free += space.at(p, kMargin_m) == Place::kFree ? 1 : 0;
  EXPECT_LT(free, floor.size() / 200);
}

TEST(FreeSpace, NothingIsKnownWithoutRays) {
  EXPECT_EQ(FreeSpace().at({1, 0, 0}, kMargin_m), Place::kUnknown);
  const FreeSpace only_bad(cloudSeenFromOrigin({{0, 0, 0}, {NAN, 0, 0}, {INFINITY, 0, 0}}));
  EXPECT_EQ(only_bad.at({1, 0, 0}, kMargin_m), Place::kUnknown);
  const FreeSpace space(wall({{0, 0, 0}}));
  EXPECT_EQ(space.at({0, 0, 0}, kMargin_m), Place::kUnknown);
  EXPECT_EQ(space.at({NAN, 0, 0}, kMargin_m), Place::kUnknown);
}

/** The middle of a cell, as a direction: the map's inverse. */
Vector3f directionOf(size_t cell) {
  const auto middle = [](size_t k) {
    return (2.0f * static_cast<float>(k) + 1) / octahedral::kEdge - 1;
  };
  float u = middle(cell % octahedral::kEdge), v = middle(cell / octahedral::kEdge);
  const float z = 1 - std::abs(u) - std::abs(v);
  if (z < 0) {
    const float unfolded = (1 - std::abs(v)) * (u < 0 ? -1.0f : 1.0f);
    v = (1 - std::abs(u)) * (v < 0 ? -1.0f : 1.0f);
    u = unfolded;
  }
  return Vector3f(u, v, z).normalized();
}

/** On the diamond's edge a middle belongs to both halves, and rounding decides. */
bool isOnTheEquator(size_t cell) {
  return std::abs(directionOf(cell).z()) < 1e-4f;
}

TEST(OctahedralMap, IsOneToOne) {
  for (size_t cell = 0; cell < octahedral::kCells; ++cell)
    if (!isOnTheEquator(cell)) {
      EXPECT_EQ(octahedral::cellOf(directionOf(cell)), cell);
    }
}

TEST(OctahedralMap, NeighborsLookTheSameWay) {
  for (size_t cell = 0; cell < octahedral::kCells; ++cell)
    for (const size_t neighbor : octahedral::neighborhood(cell)) {
      const float cosine = directionOf(cell).dot(directionOf(neighbor));
      EXPECT_LT(std::acos(std::min(cosine, 1.0f)), 5.5 * M_PI / 180) << cell << " " << neighbor;
    }
}

}  // namespace
}  // namespace lamp
