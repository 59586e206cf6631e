#include "lamp/scans/PlaceDescriptor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "TestRooms.h"

namespace lamp {
namespace {

using Points = std::vector<Eigen::Vector3f>;

constexpr double kDegree = M_PI / 180;

/** Points as a robot sees them that stands at (x, y) and is turned by `yaw`. */
Points seenFrom(Points points, float x, float y, double yaw) {
  const Eigen::AngleAxisf turn(static_cast<float>(-yaw), Eigen::Vector3f::UnitZ());
  for (Eigen::Vector3f& point : points) point = turn * (point - Eigen::Vector3f(x, y, 0));
  return points;
}

Points room(bool planar, unsigned seed) {
  return planar ? planarRoomPoints(600, 0.01f, seed) : roomPoints(4000, 0.01f, seed);
}

class PlaceDescriptorOf : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(SpaceAndPlane, PlaceDescriptorOf, testing::Bool());

TEST_P(PlaceDescriptorOf, KnowsThePlaceAndTheHeadingWhicheverWayTheRobotIsTurned) {
  const bool planar = GetParam();
  const PlaceDescriptor first(room(planar, 1), 10, planar);
  for (const double yaw : {-179.0, -120.0, -31.0, 0.0, 4.5, 90.0, 170.0}) {
    const PlaceDescriptor second(seenFrom(room(planar, 2), 0.3f, -0.2f, yaw * kDegree), 10, planar);
    const PlaceMatch found = match(first, second);
    EXPECT_NEAR(std::remainder(found.heading - yaw * kDegree, 2 * M_PI), 0, 5 * kDegree) << yaw;
    EXPECT_GT(found.similarity, 0.6) << yaw;
    EXPECT_GT(first.magnitudes().dot(second.magnitudes()), 0.6F) << yaw;
  }
}

TEST_P(PlaceDescriptorOf, TellsAnotherPlaceFromTheSameOne) {
  const bool planar = GetParam();
  const PlaceDescriptor here(room(planar, 1), 10, planar);
  Points corridor;
  for (int i = 0; i < 2000; ++i) {
    const float x = 0.01f * static_cast<float>(i) - 10;
    for (const float y : {-1.0f, 1.0f}) corridor.emplace_back(x, y, 0.001f * static_cast<float>(i));
  }
  const PlaceMatch same =
      match(here, PlaceDescriptor(seenFrom(room(planar, 2), 0, 0, 1), 10, planar));
  const PlaceMatch other = match(here, PlaceDescriptor(corridor, 10, planar));
  EXPECT_LT(other.similarity, same.similarity - 0.15);
}

TEST_P(PlaceDescriptorOf, HeightCountsInSpaceOnly) {
  const bool planar = GetParam();
  Points low = room(true, 1), high = low;
  for (Eigen::Vector3f& point : high) point.z() = 2.5f;
  const double similarity =
      match(PlaceDescriptor(low, 10, planar), PlaceDescriptor(high, 10, planar)).similarity;
  if (planar)
    EXPECT_GT(similarity, 0.999);
  else
    EXPECT_LT(similarity, 0.001);
}

TEST_P(PlaceDescriptorOf, WithoutPointsNothingIsAlike) {
  const bool planar = GetParam();
  const PlaceDescriptor here(room(planar, 1), 10, planar);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const Points& hopeless :
       {Points{}, Points{{kNan, 0, 0}, {0, kNan, kNan}}, Points{{900, 0, 0}}}) {
    const PlaceDescriptor nothing(hopeless, 10, planar);
    EXPECT_EQ(nothing.magnitudes().norm(), 0);
    EXPECT_EQ(match(here, nothing).similarity, 0);
    EXPECT_EQ(match(nothing, nothing).similarity, 0);
  }
}

TEST(PlaceDescriptor, SpaceAndPlaneHaveNothingInCommon) {
  EXPECT_EQ(
      match(PlaceDescriptor(room(true, 1), 10, true), PlaceDescriptor(room(true, 1), 10, false))
          .similarity,
      0);
}

TEST(PlaceDescriptor, ALinePassedBothWaysIsAlikeInTwoHeadings) {
  Points line;
  for (int i = -500; i <= 500; ++i) line.emplace_back(0.01f * static_cast<float>(i), 0.0f, 0.0f);
  const PlaceMatch found = match(PlaceDescriptor(line, 10, true), PlaceDescriptor(line, 10, true));
  EXPECT_GT(found.similarity, 0.999);
  EXPECT_NEAR(std::remainder(found.heading, M_PI), 0, 5 * kDegree);
}

}  // namespace
}  // namespace lamp
