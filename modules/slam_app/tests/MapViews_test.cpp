#include "MapViews.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace lamp;
using Eigen::Vector3f;

namespace {

constexpr float kStep = 0.1f;

/** A floor of 20 by 8 metres at z = 0 with walls 3 m high, one of which divides it at x = 10. */
std::vector<Vector3f> twoRooms() {
  std::vector<Vector3f> points;
  for (float x = 0; x < 20; x += kStep)
    for (float y = 0; y < 8; y += kStep) points.emplace_back(x, y, 0.05f);
  for (float z = 0.05f; z < 3; z += kStep) {
    for (float y = 0; y < 8; y += kStep)
      for (const float x : {0.0f, 10.0f, 19.9f}) points.emplace_back(x, y, z);
    for (float x = 0; x < 20; x += kStep)
      for (const float y : {0.0f, 7.9f}) points.emplace_back(x, y, z);
  }
  return points;
}

}  // namespace

TEST(MapViews, StandpointsAreApartAboveTheFloorAndInBothRooms) {
  const auto places = standpoints(twoRooms(), 0.8f, 3, 100);
  int left = 0, right = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    for (size_t k = 0; k < i; ++k) EXPECT_GE((places[i] - places[k]).norm(), 3);
    if (places[i].z() > 2) continue;  // the top of a wall looks like a floor, too
    EXPECT_NEAR(places[i].z(), 0.8, 0.3);
    (places[i].x() < 10 ? left : right) += 1;
  }
  EXPECT_GE(left, 4);
  EXPECT_GE(right, 4);
}

TEST(MapViews, ThereAreNoMoreStandpointsThanAskedFor) {
  EXPECT_EQ(standpoints(twoRooms(), 0.8f, 1, 5).size(), 5u);
}

TEST(MapViews, TheFirstStandpointOnAFloorIsInTheOpen) {
  const auto places = standpoints(twoRooms(), 0.8f, 3, 100);
  const auto place = std::find_if(places.begin(), places.end(), [](auto& p) { return p.z() < 2; });
  ASSERT_NE(place, places.end());
  EXPECT_GT(place->y(), 1.5);
  EXPECT_LT(place->y(), 6.5);
  EXPECT_GT(std::abs(place->x() - 10), 1.5);
}

TEST(MapViews, WallsHideWhatIsFarBehindThem) {
  const auto seen = visibleFrom({3, 4, 1}, twoRooms(), 30);
  EXPECT_GT(seen.size(), 5000u);
  const auto behind =
      std::count_if(seen.begin(), seen.end(), [](const Vector3f& point) { return point.x() > 16; });
  EXPECT_LT(behind, 10) << "but for the edge of the wall";
}

TEST(MapViews, NothingIsSeenBeyondTheRange) {
  for (const Vector3f& point : visibleFrom({3, 4, 1}, twoRooms(), 4))
    EXPECT_LE((point - Vector3f(3, 4, 1)).norm(), 4);
}
