#include "lamp/maps/OccupancyGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/serialization/CArchive.h>

#include "MapServerGrid.h"
#include "TestGround.h"
#include "TestOctrees.h"
#include "TestRays.h"
#include "lamp/maps/OctoMap.h"

namespace lamp {
namespace {

using test::MapServerGrid;
using testing::HasSubstr;

/** The files of a map's grids, in a folder of their own. */
struct WrittenGrids {
  explicit WrittenGrids(const ComponentMap& map)
      : files(OccupancyGrid().exportMap(map, stem)), first(stem + ".yaml") {}

  MapServerGrid storey(int k) const {
    return MapServerGrid(stem + ".storey" + std::to_string(k) + ".yaml");
  }

  const std::string stem = freshFolder() + "/map";
  const std::vector<std::string> files;
  const MapServerGrid first;
};

TEST(OccupancyGrid, IsFreeInAHallOccupiedAtItsWallsAndUnknownOutside) {
  TestMap test;
  hall().drive({{1, 0, 0.05}, {9, 0, 0.05}}, test);
  const MapServerGrid grid = WrittenGrids(test.map).first;
  EXPECT_DOUBLE_EQ(grid.resolution(), 0.2);
  for (double x = 1; x < 8; x += 0.1)
    for (double y = -1; y < 1; y += 0.1) EXPECT_EQ(grid.at(x, y), 0) << x << " " << y;
  for (double y = -2.9; y < 2.9; y += 0.1)
    for (const double x : {-0.9, 10.9}) EXPECT_EQ(grid.at(x, y), 100) << x << " " << y;
  for (const double x : {-1.3, 11.5}) EXPECT_EQ(grid.at(x, 0), -1);
}

TEST(OccupancyGrid, SaysWhatTheOctreeSays) {
  TestMap test;
  GroundWorld world = hall();
  world.addWall(5, 1.1, 6, 1.1, 0.05, 0.6);   // low
  world.addWall(5, -1.1, 6, -1.1, 0.7, 1.2);  // a bar at breast height
  world.addWall(3, -2.1, 4, -2.1, 1.3, 2.0);  // over the robot
  world.drive({{1, 0, 0.05}, {9, 0, 0.05}}, test);
  const WrittenGrids grids(test.map);
  const auto tree = readLogOdds(OctoMap().exportMap(test.map, grids.stem).at(0));
  ASSERT_TRUE(tree);
  size_t occupied = 0, free = 0;
  for (int row = 0; row < grids.first.height(); ++row)
    for (int column = 0; column < grids.first.width(); ++column) {
      const double x = grids.first.x(column), y = grids.first.y(row);
      const auto voxel = [&](int above) { return cellAt(*tree, x, y, 0.1 + 0.2 * above); };
      bool blocked = false;
      for (int above = 1; above <= 4; ++above) blocked |= voxel(above) == Cell::kOccupied;
      const int cell = grids.first.cell(column, row);
      EXPECT_EQ(cell == 100, blocked) << x << " " << y;
      if (cell == 0) {
        EXPECT_EQ(voxel(0), Cell::kOccupied);
        EXPECT_EQ(voxel(3), Cell::kFree);
        EXPECT_EQ(voxel(4), Cell::kFree);
      }
      occupied += cell == 100;
      free += cell == 0;
    }
  EXPECT_GT(occupied, 150u);
  EXPECT_GT(free, 1200u);
  EXPECT_EQ(grids.first.at(5.5, 1.1), 100);
  EXPECT_EQ(grids.first.at(5.5, -1.1), 100);
  EXPECT_EQ(grids.first.at(3.5, -2.1), 0);
}

TEST(OccupancyGrid, MrptReadsTheSameFromBothFiles) {
  TestMap test;
  hall().drive({{1, 0, 0.05}, {9, 0, 0.05}}, test);
  test.map.world_p_origin = {100000, -100000, 0};
  const WrittenGrids grids(test.map);
  mrpt::maps::COccupancyGridMap2D of_yaml, of_gridmap;
  ASSERT_TRUE(of_yaml.loadFromROSMapServerYAML(grids.stem + ".yaml"));
  mrpt::io::CFileGZInputStream file(grids.stem + ".gridmap");
  mrpt::serialization::archiveFrom(file) >> of_gridmap;
  EXPECT_NEAR(of_gridmap.getResolution(), 0.2, 1e-6);
  size_t known = 0;
  for (int row = 0; row < grids.first.height(); ++row)
    for (int column = 0; column < grids.first.width(); ++column) {
      const auto x = static_cast<float>(grids.first.x(column)),
                 y = static_cast<float>(grids.first.y(row));
      const int cell = grids.first.cell(column, row);
      known += cell >= 0;
      for (const auto* grid : {&of_yaml, &of_gridmap}) {
        const float free = grid->getPos(x, y);
        EXPECT_EQ(free > 0.8f ? 0 : free < 0.2f ? 100 : -1, cell) << x << " " << y;
      }
    }
  EXPECT_GT(known, 1400u);
}

TEST(OccupancyGrid, TheOffsetFromTheWorldIsAComment) {
  TestMap near, far;
  far.map.world_p_origin = {100000, -100000, 0};
  for (TestMap* test : {&near, &far}) hall().drive({{1, 0, 0.05}, {9, 0, 0.05}}, *test);
  const WrittenGrids here(near.map), there(far.map);
  const std::string comment = "# offset 100000 -100000 0\n";
  EXPECT_EQ(bytesOf(there.stem + ".yaml"), comment + bytesOf(here.stem + ".yaml"));
  EXPECT_THAT(bytesOf(there.stem + ".pgm"), HasSubstr("P5\n" + comment));
  EXPECT_EQ(there.first.at(5, 0), 0);
}

TEST(OccupancyGrid, FollowsARampAndKeepsStoreysApart) {
  TestMap test;
  TwoStoreys building;
  building.world.addWall(10.1, 3, 10.1, 3.9, 0.05, 1);    // in the hall, under the gallery
  building.world.addWall(14.1, 3, 14.1, 3.6, 3.25, 4.2);  // on the gallery
  building.drive(test);
  const WrittenGrids grids(test.map);
  ASSERT_EQ(grids.files.size(), 6u);
  const MapServerGrid below = grids.first, above = grids.storey(1);
  for (double x = 3; x < 20; x += 0.1) EXPECT_EQ(below.at(x, 0), 0) << x;
  for (double x = 4; x < building.top + 1; x += 0.1) EXPECT_EQ(above.at(x, 4.1), 0) << x;
  const double middle = (20 + building.top) / 2;
  for (double x = 20; x < middle; x += 0.1) EXPECT_EQ(below.at(x, 0), 0) << x;
  for (double x = middle; x < building.top; x += 0.1) EXPECT_EQ(above.at(x, 0), 0) << x;
  EXPECT_EQ(below.at(10.1, 3.3), 100);
  EXPECT_EQ(above.at(10.1, 4.1), 0);
  EXPECT_EQ(above.at(14.1, 3.3), 100);
  EXPECT_EQ(above.at(10, 0), -1) << "there is no gallery";
  for (const MapServerGrid* grid : {&below, &above}) EXPECT_NE(grid->at(middle, 0), 100);
}

TEST(OccupancyGrid, StepsAreGroundUpToTheHighestThatARobotClimbs) {
  TestMap test;
  GroundWorld world;
  world.addFloor(-1, 5, -2, 2, [](double x, double y) {
    return x < 3 ? 0.05 : y < 0 ? 0.25 : 0.7;
  });
  world.addWall(3, -2, 3, 0, 0.05, 0.25);
  world.addWall(3, 0, 3, 2, 0.05, 0.7);
  world.addWall(4.7, -2, 4.7, 2, 0.05, 2);
  world.drive({{0, 0, 0.05}, {2, 0, 0.05}}, test);
  const MapServerGrid grid = WrittenGrids(test.map).first;
  for (double x = 3.1; x < 4.3; x += 0.2) EXPECT_NE(grid.at(x, -0.9), 100) << x;
  EXPECT_EQ(grid.at(3.1, 1.1), 100);
}

TEST(OccupancyGrid, ARobotWithALevelLaserGetsTheLayerOfTheLaser) {
  TestMap test;
  std::vector<Eigen::Vector3f> wall;
  for (float y = -2; y <= 2; y += 0.02f) wall.push_back({5.1f, y, 0});
  test.add(0, planarPose(0.01, 0.01, 0), makeScan(wall, {0, 0, 0}));
  test.addTrack(0, {{0, 0}, {0.5, 0}});
  const WrittenGrids grids(test.map);
  EXPECT_EQ(grids.files.size(), 3u);
  // One scan of a line shows no surface: half of its rays is free.
  for (double x = 0.1; x < 2.4; x += 0.1) EXPECT_EQ(grids.first.at(x, 0.01), 0) << x;
  for (double y = -1.9; y < 2; y += 0.1) EXPECT_EQ(grids.first.at(5.11, y), 100) << y;
  EXPECT_EQ(grids.first.at(6, 0), -1);
  EXPECT_EQ(grids.first.at(1, 2), -1);
}

TEST(OccupancyGrid, TakesAwayTheFilesOfStoreysThatAreNoMore) {
  TestMap tall, low;
  TwoStoreys().drive(tall);
  hall().drive({{1, 0, 0.05}, {9, 0, 0.05}}, low);
  const std::string folder = freshFolder();
  OccupancyGrid exporter;
  exporter.exportMap(tall.map, folder + "/map");
  EXPECT_EQ(fileCount(folder), 6u);
  exporter.exportMap(low.map, folder + "/other");
  EXPECT_EQ(fileCount(folder), 9u);
  exporter.exportMap(low.map, folder + "/map");
  EXPECT_EQ(fileCount(folder), 6u);
}

TEST(OccupancyGrid, AMapWithoutAnythingIsOneUnknownCell) {
  const TestMap test;
  const MapServerGrid grid = WrittenGrids(test.map).first;
  EXPECT_EQ(grid.width(), 1);
  EXPECT_EQ(grid.height(), 1);
  EXPECT_EQ(grid.cell(0, 0), -1);
}

TEST(OccupancyGrid, AGridThatIsTooLargeSaysWhatToDo) {
  TestMap test;
  for (const double x : {-6000.0, 6000.0}) test.add(0, planarPose(x, x, 0), makeScan({{2, 0, 0}}));
  EXPECT_THAT(errorOf([&] { WrittenGrids{test.map}; }),
              HasSubstr("raise [occupancy] resolution_m"));
}

}  // namespace
}  // namespace lamp
