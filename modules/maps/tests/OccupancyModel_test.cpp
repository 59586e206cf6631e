// What the occupancy says of surfaces whose truth is known.
#include <gtest/gtest.h>

#include "TestOctrees.h"
#include "TestRays.h"
#include "lamp/maps/OctoMap.h"

namespace lamp {
namespace {

using Eigen::Vector3d;

std::unique_ptr<octomap::OcTree> mapOf(const TestMap& test, const OccupancyOptions& options = {}) {
  ComponentMap map = test.map;
  map.occupancy = std::make_shared<Occupancy>(options);
  return readLogOdds(OctoMap().exportMap(map, freshFolder() + "/map").at(0));
}

/** Cells at points of a surface. */
struct SurfaceCells {
  size_t occupied = 0, free = 0, unknown = 0;

  void add(Cell cell) {
    ++(cell == Cell::kOccupied ? occupied : cell == Cell::kFree ? free : unknown);
  }
};

class GrazedWall : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Incidence, GrazedWall, testing::Values(2, 5, 10, 20, 45, 90),
                         testing::PrintToStringParamName());

/** The wall y = 0.03 is hit ten metres away, by beams one degree apart. */
TEST_P(GrazedWall, IsNowhereFreeAndTheSpaceBeforeItIs) {
  const double incidence = GetParam() * M_PI / 180, height = 10 * std::sin(incidence);
  const double along = 10 * std::cos(incidence);
  TestMap test;
  for (const double shift : {0.0, 0.37, 0.81}) {
    const Vector3d eye(shift, 0.03 + height, 0.11);
    const Vector3d middle(shift + along, 0.03, 0.11);
    const Vector3d axis = (middle - eye).normalized(), side = axis.cross(Vector3d::UnitZ());
    std::vector<Eigen::Vector3f> points;
    for (int i = -8; i <= 8; ++i)
      for (int k = -8; k <= 8; ++k) {
        const Vector3d ray =
            axis + std::tan(i * M_PI / 180) * side + std::tan(k * M_PI / 180) * Vector3d::UnitZ();
        if (ray.y() >= 0) continue;
        const Vector3d point = -height / ray.y() * ray;
        if (point.norm() < 14) points.push_back(point.cast<float>());
      }
    ASSERT_GT(points.size(), 20u);
    test.add(0, Pose3(Eigen::Translation3d(eye)), makeScan(points));
  }
  const auto tree = mapOf(test);
  SurfaceCells wall;
  for (double x = -2; x < along + 8; x += 0.05)
    for (double z = -3; z < 3; z += 0.05) wall.add(cellAt(*tree, x, 0.03, z));
  EXPECT_GT(wall.occupied, 100u);
  EXPECT_EQ(wall.free, 0u);
  if (height < 1) return;
  for (const double share : {0.2, 0.4, 0.6})
    EXPECT_EQ(cellAt(*tree, 0.37 + share * along, 0.03 + (1 - share) * height, 0.11), Cell::kFree)
        << share;
}

TEST(OccupancyModel, AThinPoleStays) {
  RayWorld world;
  world.poles.push_back({3.1, 0.1, 0.04});
  world.addBox({-10, 8, -3}, {20, 9, 3});
  world.addBox({-10, -9, -3}, {20, -8, 3});
  TestMap test;
  for (double x = -4; x <= 10; x += 1) world.look({x, -1.9, 0.1}, test);
  const auto tree = mapOf(test);
  for (double z = -0.7; z < 0.8; z += 0.2)
    EXPECT_EQ(cellAt(*tree, 3.1, 0.1, z), Cell::kOccupied) << z;
  EXPECT_EQ(cellAt(*tree, 3.1, 1.5, 0.1), Cell::kFree);
  EXPECT_EQ(cellAt(*tree, 4.1, 0.1, 0.1), Cell::kFree);
}

TEST(OccupancyModel, ADoorwaySeenThroughFromAfarIsOpen) {
  RayWorld world;
  world.addBox({6, -8, -3}, {6.3, -0.5, 3});
  world.addBox({6, 0.5, -3}, {6.3, 8, 3});
  world.addBox({12, -8, -3}, {12.3, 8, 3});
  TestMap test;
  for (const double x : {-3.0, -1.0, 1.0, 3.0}) world.look({x, 0.1, 0.1}, test);
  const auto tree = mapOf(test);
  // Farther on, the lasers pass above and below.
  for (double x = 5.1; x < 8.8; x += 0.2) EXPECT_EQ(cellAt(*tree, x, 0.1, 0.1), Cell::kFree) << x;
  for (const double y : {-1.5, -0.9, 0.9, 1.5})
    EXPECT_EQ(cellAt(*tree, 6.01, y, 0.1), Cell::kOccupied);
  EXPECT_EQ(cellAt(*tree, 12.01, 0.1, 0.1), Cell::kOccupied);
}

TEST(OccupancyModel, BothFloorsAtAStepStay) {
  RayWorld world;
  world.addBox({-8, -8, -2}, {3.05, 8, -0.55});
  world.addBox({-8, -8, -2}, {14, 8, -0.95});
  TestMap test;
  for (double x = -3; x <= 7; x += 1) world.look({x, 0.1, x < 3 ? 0.15 : -0.25}, test);
  const auto tree = mapOf(test);
  SurfaceCells floors;
  for (double y = -2; y < 2; y += 0.05) {
    for (double x = -3; x < 3; x += 0.05) floors.add(cellAt(*tree, x, y, -0.551));
    for (double x = 3.1; x < 7; x += 0.05) floors.add(cellAt(*tree, x, y, -0.951));
    for (double z = -0.9; z < -0.6; z += 0.05) floors.add(cellAt(*tree, 3.05, y, z));
  }
  EXPECT_EQ(floors.free, 0u);
  EXPECT_GT(floors.occupied, 4 * floors.unknown);
  for (double x = -2.9; x < 3; x += 0.2) EXPECT_EQ(cellAt(*tree, x, 0.1, 0.1), Cell::kFree) << x;
  for (double x = 3.5; x < 7; x += 0.2) EXPECT_EQ(cellAt(*tree, x, 0.1, -0.3), Cell::kFree) << x;
}

/** A hall with a box in the middle while the scan is one of those that see it. */
void fillHallWithBox(const std::function<bool(int)>& is_there, TestMap& test) {
  RayWorld hall;
  hall.addBox({-1, 5, -3}, {12, 6, 3});
  hall.addBox({-1, -6, -3}, {12, -5, 3});
  hall.addBox({12, -6, -3}, {13, 6, 3});
  RayWorld with_box = hall;
  with_box.addBox({5, -0.3, -0.5}, {5.6, 0.3, 0.5});
  for (int i = 0; i < 12; ++i)
    (is_there(i) ? with_box : hall).look({0.5 + 0.6 * i, i % 2 ? 1.3 : 1.7, 0.1}, test);
}

TEST(OccupancyModel, WhatCameAndLeftGoes) {
  TestMap test;
  fillHallWithBox([](int scan) { return scan == 2 || scan == 3; }, test);
  const auto tree = mapOf(test);
  for (const double y : {-0.1, 0.1})
    for (const double x : {5.1, 5.3})
      EXPECT_EQ(cellAt(*tree, x, y, 0.1), Cell::kFree) << x << " " << y;
}

/** The last voxels of the trail were seen through more before than after. */
TEST(OccupancyModel, WhatMovesThroughLeavesNoTrail) {
  RayWorld hall;
  hall.addBox({-1, 5, -3}, {12, 6, 3});
  hall.addBox({-1, -6, -3}, {12, -5, 3});
  hall.addBox({12, -6, -3}, {13, 6, 3});
  TestMap test;
  for (int i = 0; i < 12; ++i) {
    RayWorld now = hall;
    const double y = -0.9 + 0.6 * (i - 7);
    if (i >= 7 && i <= 10) now.addBox({8.5, y, -0.5}, {9.1, y + 0.6, 0.5});
    now.look({0.5 + 0.6 * i, i % 2 ? 0.5 : 0.1, 0.1}, test);
  }
  const auto tree = mapOf(test);
  SurfaceCells trail;
  for (double y = -0.8; y < 1.4; y += 0.1)
    for (double z = -0.3; z < 0.3; z += 0.1) trail.add(cellAt(*tree, 8.51, y, z));
  EXPECT_EQ(trail.occupied, 0u);
}

TEST(OccupancyModel, WhatCameAndStaysIsThere) {
  TestMap test;
  fillHallWithBox([](int scan) { return scan >= 9; }, test);
  const auto tree = mapOf(test);
  EXPECT_EQ(cellAt(*tree, 5.5, 0.29, 0.1), Cell::kOccupied);
}

TEST(OccupancyModel, LookingFromOnePlaceOnlyRemovesNothing) {
  RayWorld empty, with_box;
  empty.addBox({12, -6, -3}, {13, 6, 3});
  with_box = empty;
  with_box.addBox({3, -0.3, -0.5}, {3.6, 0.3, 0.5});
  TestMap test;
  with_box.look({0.1, 0.1, 0.1}, test);
  for (int i = 0; i < 12; ++i) empty.look({0.1, 0.1 + 0.01 * i, 0.1}, test);
  EXPECT_EQ(cellAt(*mapOf(test), 3.01, 0.1, 0.1), Cell::kOccupied);
}

TEST(OccupancyModel, SpecksOfDustAreNoObstacles) {
  RayWorld world;
  world.addBox({9, -9, -3}, {10, 9, 3});
  TestMap test;
  for (int i = 0; i < 5; ++i) world.look({0.7 * i, 0.1, 0.1}, test);
  auto dusty = std::make_shared<Scan>(*test.map.key_nodes[0].scan);
  dusty->points.push_back({4.0f, 0, 0});
  dusty->sensor.push_back(0);
  test.map.key_nodes[0].scan = dusty;
  EXPECT_EQ(cellAt(*mapOf(test), 4.0, 0.1, 0.1), Cell::kFree);
}

/** Floor at z = 0.05 that the lidar sees in two stripes only, and a way between them. */
void fillStripedFloor(TestMap& test) {
  std::vector<Eigen::Vector3f> stripes;
  for (float x = -4; x < 4; x += 0.05f)
    for (const float y : {-0.1f, 0.1f}) stripes.push_back({x, y, -0.55f});
  test.add(0, Pose3(Eigen::Translation3d(0, 0, 0.6)), makeScan(stripes));
  MapTrack track;
  for (double x = -3; x < 3; x += 0.1)
    track.poses.push_back({x, Pose3(Eigen::Translation3d(x, 0, 0.6))});
  test.map.tracks.push_back(track);
}

TEST(OccupancyModel, TheGroundUnderTheWayIsKnownAndTheBodysSpaceFree) {
  TestMap test;
  fillStripedFloor(test);
  const auto tree = mapOf(test);
  for (double x = -2.9; x < 2.9; x += 0.2)
    for (const double y : {-0.3, 0.1, 0.3}) {
      EXPECT_EQ(cellAt(*tree, x, y, 0.05), Cell::kOccupied) << x << " " << y;
      EXPECT_EQ(cellAt(*tree, x, y, 0.5), Cell::kFree) << x << " " << y;
    }
  EXPECT_EQ(cellAt(*tree, 0.1, 0.9, 0.05), Cell::kUnknown);

  OccupancyOptions seen_only;
  seen_only.driven_ground = false;
  EXPECT_EQ(cellAt(*mapOf(test, seen_only), 0.1, 0.5, 0.05), Cell::kUnknown);
}

/** A box stands on the way as one robot comes by, at the time of its key node. */
void placeBoxOnWay(double stamp, TestMap& test) {
  std::vector<Eigen::Vector3f> box;
  for (float y = -0.3f; y < 0.3f; y += 0.05f)
    for (float z = 0.06f; z < 0.35f; z += 0.05f) box.push_back({1.1f, y, z});
  test.add(1, Pose3(Eigen::Translation3d(0, 0, 0.6)), makeScan(box));
  test.map.key_nodes.back().stamp = stamp;
}

TEST(OccupancyModel, WhatStoodWhereARobotDroveLaterIsGone) {
  TestMap test;
  fillStripedFloor(test);  // at x = 1.1 the robot is at the time 1.1
  test.map.key_nodes.back().stamp = -10;
  placeBoxOnWay(-5, test);
  const auto tree = mapOf(test);
  EXPECT_EQ(cellAt(*tree, 1.1, 0.1, 0.7), Cell::kFree);
}

TEST(OccupancyModel, WhatStandsWhereARobotDroveBeforeIsThere) {
  TestMap test;
  fillStripedFloor(test);
  test.map.key_nodes.back().stamp = -10;
  placeBoxOnWay(20, test);
  const auto tree = mapOf(test);
  EXPECT_EQ(cellAt(*tree, 1.1, 0.1, 0.7), Cell::kOccupied);
}

TEST(OccupancyModel, ARobotThatSeesNoGroundGetsNone) {
  TestMap test;
  fillStripedFloor(test);
  // A level laser: all that it sees is at its own height, and beside the way.
  std::vector<Eigen::Vector3f> walls;
  for (float x = -4; x < 4; x += 0.05f)
    for (const float y : {-2.1f, 2.1f}) walls.push_back({x, y, 0});
  test.map.key_nodes.front().scan = makeScan(walls);
  const auto tree = mapOf(test);
  size_t occupied_on_way = 0;
  for (double x = -3; x < 3; x += 0.1)
    for (double z = -0.5; z < 1; z += 0.1)
      occupied_on_way += cellAt(*tree, x, 0.1, z) == Cell::kOccupied;
  EXPECT_EQ(occupied_on_way, 0u);
}

}  // namespace
}  // namespace lamp
