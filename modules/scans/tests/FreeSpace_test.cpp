#include "lamp/scans/FreeSpace.h"

#include <gtest/gtest.h>

namespace lamp {
namespace {

using Place = FreeSpace::Place;

/** A wall at x = 5, seen from `eye`. */
Cloud wall(const Eigen::Vector3f& eye) {
  Cloud cloud;
  for (float y = -4; y <= 4; y += 0.1f)
    for (float z = -2; z <= 2; z += 0.1f) cloud.points.emplace_back(5, y, z);
  cloud.viewpoint.assign(cloud.points.size(), 0);
  cloud.viewpoints = {eye};
  return cloud;
}

TEST(FreeSpace, IsBeforeTheWallOnItAndUnknownBehindAndBeside) {
  for (const Eigen::Vector3f& eye : {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, 0.5f, -0.3f)}) {
    const FreeSpace space(wall(eye));
    EXPECT_EQ(space.at({3, 0.2f, 0.1f}, 0.3f), Place::kFree);
    EXPECT_EQ(space.at({5.1f, 0.2f, 0.1f}, 0.3f), Place::kSurface);
    EXPECT_EQ(space.at({4.9f, -1, 0.4f}, 0.3f), Place::kSurface);
    EXPECT_EQ(space.at({8, 0.2f, 0.1f}, 0.3f), Place::kUnknown);
    EXPECT_EQ(space.at({-3, 0, 0}, 0.3f), Place::kUnknown);
  }
}

TEST(FreeSpace, OneRayOfManyViewsIsEnough) {
  Cloud cloud = wall({0, 0, 0});
  cloud.viewpoints.emplace_back(0, 50, 0);  // sees nothing
  EXPECT_EQ(FreeSpace(cloud).at({3, 0, 0}, 0.3f), Place::kFree);
}

TEST(FreeSpace, AFloorAtASlantIsNotFreeOfItself) {
  Cloud floor;
  for (float x = -15; x <= 15; x += 0.4f)
    for (float y = -15; y <= 15; y += 0.4f) floor.points.emplace_back(x, y, -1.0f);
  floor.viewpoint.assign(floor.points.size(), 0);
  floor.viewpoints = {Eigen::Vector3f::Zero()};
  const FreeSpace space(floor);
  size_t free = 0;
  for (const auto& point : floor.points) free += space.at(point, 0.3f) == Place::kFree;
  EXPECT_EQ(free, 0u);
}

TEST(FreeSpace, OfNothingNothingIsKnown) {
  EXPECT_EQ(FreeSpace().at({1, 0, 0}, 0.3f), Place::kUnknown);
  EXPECT_EQ(FreeSpace(cloudSeenFromOrigin({})).at({1, 0, 0}, 0.3f), Place::kUnknown);
}

}  // namespace
}  // namespace lamp
