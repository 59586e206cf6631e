#include "lamp/scans/PlanarAlignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "TestRooms.h"

namespace lamp {
namespace {

using Points = std::vector<Eigen::Vector3f>;

constexpr double kDegree = M_PI / 180;

Points moved(Points points, const Pose3& T) {
  for (Eigen::Vector3f& point : points) point = T.cast<float>() * point;
  return points;
}

/** Share of the source's points whose cell holds a point of the target, or a cell beside it does.
 */
double shareAt(const Points& source, const OccupancyPyramid& target, const Pose3& target_T_source) {
  int on = 0;
  for (const Eigen::Vector3f& point : moved(source, target_T_source))
    on += target.occupied(0, OccupancyPyramid::cellOf(point.x()),
                          OccupancyPyramid::cellOf(point.y()));
  return static_cast<double>(on) / static_cast<double>(source.size());
}

TEST(PlanarAlignment, FindsThePoseWithoutAGuess) {
  const OccupancyPyramid target(planarRoomPoints(720, 0.01f, 1));
  for (const auto& [x, y, yaw] : {std::tuple(0.0, 0.0, 0.0), std::tuple(1.7, -0.9, 123.0),
                                  std::tuple(-2.2, 1.4, -171.0), std::tuple(6.5, -4.0, 60.0)}) {
    const Pose3 truth = planarPose(x, y, yaw * kDegree);
    const auto found =
        alignInPlane(moved(planarRoomPoints(360, 0.01f, 2), truth.inverse()), target, 10, 5);
    ASSERT_FALSE(found.empty());
    const Pose3 error = truth.inverse() * found.front().target_T_source;
    EXPECT_LT(error.translation().norm(), 0.4) << x << " " << y << " " << yaw;
    EXPECT_LT(rotationAngle(error), 4 * kDegree) << x << " " << y << " " << yaw;
    EXPECT_GT(found.front().share, 0.9);
  }
}

TEST(PlanarAlignment, NothingBetterIsOverlooked) {
  // Against all shifts of a coarser exhaustive search, at headings that are not the search's own.
  const OccupancyPyramid target(planarRoomPoints(720, 0.01f, 1));
  const Points source =
      moved(planarRoomPoints(240, 0.01f, 2), planarPose(0.8, 0.3, 40 * kDegree).inverse());
  const auto found = alignInPlane(source, target, 10, 5);
  ASSERT_FALSE(found.empty());
  double best = 0;
  for (double yaw = -180; yaw < 180; yaw += 2.5)
    for (double x = -4; x <= 4; x += 0.2)
      for (double y = -4; y <= 4; y += 0.2)
        best = std::max(best, shareAt(source, target, planarPose(x, y, yaw * kDegree)));
  EXPECT_GE(found.front().share, best - 0.03);
}

TEST(PlanarAlignment, APlaceThatLooksAlikeInTwoWaysGivesBoth) {
  Points rectangle;
  for (int i = 0; i < 400; ++i) {
    const float s = static_cast<float>(i) / 400;
    rectangle.emplace_back(8 * s - 4, -2.0f, 0.0f);
    rectangle.emplace_back(8 * s - 4, 2.0f, 0.0f);
    rectangle.emplace_back(-4.0f, 4 * s - 2, 0.0f);
    rectangle.emplace_back(4.0f, 4 * s - 2, 0.0f);
  }
  const auto found = alignInPlane(rectangle, OccupancyPyramid(rectangle), 10, 5);
  ASSERT_GE(found.size(), 2u);
  const double between =
      rotationAngle(found[0].target_T_source.inverse() * found[1].target_T_source);
  EXPECT_NEAR(between, M_PI, 5 * kDegree);
  EXPECT_NEAR(found[1].share, found[0].share, 0.05);
}

TEST(PlanarAlignment, StaysWithinTheRadius) {
  const OccupancyPyramid target(planarRoomPoints(720, 0.01f, 1));
  const Points source = moved(planarRoomPoints(360, 0.01f, 2), planarPose(3, 0, 0).inverse());
  for (const auto& placement : alignInPlane(source, target, 1, 5))
    EXPECT_LE(placement.target_T_source.translation().cwiseAbs().maxCoeff(), 1.0 + 1e-9);
  const auto found = alignInPlane(source, target, 4, 5);
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found.front().target_T_source.translation().x(), 3, 0.3);
}

TEST(PlanarAlignment, NothingFitsNothing) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const Points room = planarRoomPoints(720, 0.01f, 1);
  for (const Points& hopeless : {Points{}, Points{{kNan, kNan, 0}}, Points{{500, 0, 0}}}) {
    EXPECT_TRUE(alignInPlane(hopeless, OccupancyPyramid(room), 10, 5).empty());
    EXPECT_TRUE(alignInPlane(room, OccupancyPyramid(hopeless), 10, 5).empty());
  }
  EXPECT_TRUE(alignInPlane({{1, 2, 0}}, OccupancyPyramid(Points{{1, 2, 0}}), 10, 5).size() <= 5);
}

TEST(OccupancyPyramid, EachLevelBoundsTheOneBelow) {
  const OccupancyPyramid pyramid(planarRoomPoints(200, 0.01f, 3));
  for (int level = 1; level < OccupancyPyramid::kLevels; ++level) {
    const int edge = 1 << level;
    for (int x = -60; x < 60; x += 7)
      for (int y = -60; y < 60; y += 5) {
        bool any = false;
        for (int dx = 0; dx < edge; ++dx)
          for (int dy = 0; dy < edge; ++dy) any = any || pyramid.occupied(0, x + dx, y + dy);
        EXPECT_EQ(pyramid.occupied(level, x, y), any) << level << " " << x << " " << y;
      }
  }
}

}  // namespace
}  // namespace lamp
