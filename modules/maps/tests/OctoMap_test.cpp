#include "lamp/maps/OctoMap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include "TestMaps.h"
#include "TestOctrees.h"

namespace lamp {
namespace {

using testing::HasSubstr;

/** A wall across x, one metre high and four wide, as points 5 cm apart. */
std::vector<Eigen::Vector3f> wall(float x) {
  std::vector<Eigen::Vector3f> points;
  for (float y = -2; y <= 2; y += 0.05f)
    for (float z = -0.5f; z <= 0.5f; z += 0.05f) points.push_back({x, y, z});
  return points;
}

std::vector<std::string> write(ComponentMap map, const OccupancyOptions& options = {}) {
  map.occupancy = std::make_shared<Occupancy>(options);
  return OctoMap().exportMap(map, freshFolder() + "/map");
}

TEST(OctoMap, TheOffsetFromTheWorldIsACommentThatOctoMapPassesOver) {
  TestMap test;
  test.add(0, Pose3(Eigen::Translation3d(0.01, 0.01, 0.01)), makeScan(wall(5.1f)));
  test.map.world_p_origin = {431000, 5412000, 0};
  const auto paths = write(test.map);
  for (const std::string& path : paths)
    EXPECT_THAT(bytesOf(path), HasSubstr("\n# offset 431000 5412000 0\n"));
  const auto log_odds = readLogOdds(paths.at(0));
  ASSERT_TRUE(log_odds);
  EXPECT_EQ(cellAt(*log_odds, 5.11, 0, 0), Cell::kOccupied);
  octomap::OcTree binary(0.05);
  ASSERT_TRUE(binary.readBinary(paths.at(1)));
  EXPECT_EQ(cellAt(binary, 5.11, 0, 0), Cell::kOccupied);
}

TEST(OctoMap, IsFreeBeforeOccupiedAtAndUnknownBehindTheWall) {
  TestMap test;
  test.add(0, Pose3(Eigen::Translation3d(0.01, 0.01, 0.01)), makeScan(wall(5.1f)));
  const auto paths = write(test.map);
  ASSERT_EQ(paths.size(), 2u);
  const auto log_odds = readLogOdds(paths[0]);
  ASSERT_TRUE(log_odds);
  octomap::OcTree binary(0.05);
  ASSERT_TRUE(binary.readBinary(paths[1]));
  EXPECT_NEAR(binary.getResolution(), 0.2, 1e-12);

  for (const octomap::OcTree* tree : {log_odds.get(), &binary}) {
    for (double x = 0.1; x < 4.9; x += 0.2) EXPECT_EQ(cellAt(*tree, x, 0, 0), Cell::kFree) << x;
    for (double y = -1.9; y < 2; y += 0.2) EXPECT_EQ(cellAt(*tree, 5.11, y, 0), Cell::kOccupied);
    EXPECT_EQ(cellAt(*tree, 5.5, 0, 0), Cell::kUnknown);
    EXPECT_EQ(cellAt(*tree, -0.5, 0, 0), Cell::kUnknown);
    double low, high, other;
    tree->getMetricMin(low, other, other);
    tree->getMetricMax(high, other, other);
    EXPECT_NEAR(low, 0.0, 0.2);
    EXPECT_NEAR(high, 5.2, 0.2);
  }
  EXPECT_NEAR(log_odds->search(5.11, 0.05, 0.05)->getOccupancy(), 0.7, 1e-6);
  EXPECT_NEAR(log_odds->search(2.0, 0.05, 0.05)->getOccupancy(), 0.4, 1e-6);
}

TEST(OctoMap, CarvesFromTheOriginOfTheSensorThatSawThePoint) {
  TestMap test;
  const auto scan = makeScan({{5.1f, 3.1f, 0.1f}, {5.1f, -3.1f, 0.1f}});
  scan->sensors = {{"left", {0.1, 3.1, 0.1}}, {"right", {0.1, -3.1, 0.1}}};
  scan->sensor = {0, 1};
  test.add(0, planarPose(0, 0, M_PI / 2), scan);
  const auto tree = readLogOdds(write(test.map)[0]);
  ASSERT_TRUE(tree);
  // Turned by 90 degrees: the rays run along y at x = -3.1 and x = 3.1.
  for (const double x : {-3.1, 3.1}) EXPECT_EQ(cellAt(*tree, x, 2.5, 0.1), Cell::kFree) << x;
  for (const double x : {-3.1, 3.1}) EXPECT_EQ(cellAt(*tree, x, 5.1, 0.1), Cell::kOccupied) << x;
  EXPECT_EQ(cellAt(*tree, 0.1, 0.1, 0.1), Cell::kUnknown);
  EXPECT_EQ(cellAt(*tree, 1.5, 2.5, 0.1), Cell::kUnknown);
}

TEST(OctoMap, CutsLongRaysWithoutAnOccupiedEnd) {
  TestMap test;
  OccupancyOptions options;
  options.max_range_m = 3;
  test.add(0, Pose3(Eigen::Translation3d(0.1, 0.1, 0.1)), makeScan({{8, 0, 0}, {0, 2, 0}}));
  const auto tree = readLogOdds(write(test.map, options)[0]);
  ASSERT_TRUE(tree);
  EXPECT_EQ(cellAt(*tree, 2.7, 0.1, 0.1), Cell::kFree);
  EXPECT_EQ(cellAt(*tree, 3.5, 0.1, 0.1), Cell::kUnknown);
  EXPECT_EQ(cellAt(*tree, 8.1, 0.1, 0.1), Cell::kUnknown);
  EXPECT_EQ(cellAt(*tree, 0.1, 2.1, 0.1), Cell::kOccupied);
}

TEST(OctoMap, WithinOneScanAnEndWinsOverRaysThatPassEvenOfAnotherSensor) {
  TestMap test;
  const auto scan = makeScan({{2, 0, 0}, {4, 0, 0}, {4, 0.01f, 0}, {4, 0, 0.01f}});
  scan->sensors = {{"front", {0, 0, 0}}, {"rear", {-1, 0, 0}}};
  scan->sensor = {0, 1, 1, 1};
  test.add(0, Pose3(Eigen::Translation3d(0.1, 0.1, 0.1)), scan);
  const auto tree = readLogOdds(write(test.map)[0]);
  ASSERT_TRUE(tree);
  EXPECT_NEAR(tree->search(2.1, 0.1, 0.1)->getOccupancy(), 0.7, 1e-6);
}

TEST(OctoMap, ScansAddUpAndStopAtTheClamps) {
  TestMap test;
  for (int i = 0; i < 20; ++i)
    test.add(0, Pose3(Eigen::Translation3d(0.1, 0.1, 0.1)), makeScan({{2, 0, 0}}));
  const auto tree = readLogOdds(write(test.map)[0]);
  ASSERT_TRUE(tree);
  EXPECT_NEAR(tree->search(2.1, 0.1, 0.1)->getOccupancy(), 0.97, 1e-4);
  EXPECT_NEAR(tree->search(1.1, 0.1, 0.1)->getOccupancy(), 0.12, 1e-4);
}

TEST(OctoMap, EmptyMapsGiveFilesThatOpen) {
  TestMap test;
  test.add(0, Pose3::Identity(), makeScan({}));
  test.add(0, Pose3::Identity(), nullptr);
  const auto paths = write(test.map);
  const auto tree = readLogOdds(paths[0]);
  ASSERT_TRUE(tree);
  EXPECT_EQ(tree->size(), 0u);
  octomap::OcTree binary(0.05);
  EXPECT_TRUE(binary.readBinary(paths[1]));
}

TEST(OctoMap, LeavesOutPointsThatAreNotFiniteOrOutOfBounds) {
  TestMap test;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  OccupancyOptions options;
  options.max_range_m = 1e6;
  test.add(0, Pose3::Identity(), makeScan({{nan, 0, 0}, {9e4f, 0, 0}, {2.1f, 0.1f, 0.1f}}));
  const auto tree = readLogOdds(write(test.map, options)[0]);
  ASSERT_TRUE(tree);
  size_t occupied = 0;
  for (auto leaf = tree->begin_leafs(); leaf != tree->end_leafs(); ++leaf)
    if (tree->isNodeOccupied(*leaf)) ++occupied;
  EXPECT_EQ(occupied, 1u);
}

TEST(OctoMap, WritesTheSameBytesTwice) {
  TestMap test;
  test.add(0, planarPose(1, 2, 3), makeScan(wall(4)));
  const auto bytes = [&] {
    const auto paths = write(test.map);
    return bytesOf(paths[0]) + bytesOf(paths[1]);
  };
  EXPECT_EQ(bytes(), bytes());
}

TEST(OctoMap, TheBinaryFileHoldsWhatOctomapItselfWouldWrite) {
  TestMap test;
  test.add(0, planarPose(1, 2, 3), makeScan(wall(4)));
  const auto paths = write(test.map);
  const auto tree = readLogOdds(paths[0]);
  ASSERT_TRUE(tree);
  std::ostringstream expected;
  ASSERT_TRUE(tree->writeBinary(expected));
  const auto data = [](const std::string& file) { return file.substr(file.find("\nid OcTree\n")); };
  EXPECT_EQ(data(bytesOf(paths[1])), data(expected.str()));
}

TEST(OctoMap, TheLogOddsFileIsWhatOctomapItselfWouldWrite) {
  TestMap test;
  test.add(0, planarPose(1, 2, 3), makeScan(wall(4)));
  test.add(0, planarPose(2, 2, 3), makeScan(wall(5)));
  const std::string path = write(test.map).at(0);
  const auto tree = readLogOdds(path);
  ASSERT_TRUE(tree);
  const size_t nodes = tree->size();
  tree->updateInnerOccupancy();
  tree->prune();
  EXPECT_EQ(tree->size(), nodes);
  std::ostringstream expected;
  ASSERT_TRUE(tree->write(expected));
  const auto data = [](const std::string& file) { return file.substr(file.find("\nid OcTree\n")); };
  EXPECT_EQ(data(bytesOf(path)), data(expected.str()));
}

TEST(OctoMap, OnePointIsOneVoxelAndAWay) {
  TestMap test;
  test.add(0, Pose3(Eigen::Translation3d(0.1, 0.1, 0.1)), makeScan({{4, 0, 0}}));
  const auto tree = readLogOdds(write(test.map).at(0));
  ASSERT_TRUE(tree);
  EXPECT_EQ(cellAt(*tree, 4.1, 0.1, 0.1), Cell::kOccupied);
  EXPECT_EQ(cellAt(*tree, 1.1, 0.1, 0.1), Cell::kFree);
  EXPECT_EQ(cellAt(*tree, 1.1, 0.3, 0.1), Cell::kUnknown);
}

TEST(OctoMap, AMillionPointsAreAScan) {
  TestMap test;
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 1000; ++i)
    for (int k = 0; k < 1000; ++k)
      points.push_back(
          {5.1f, 0.01f * static_cast<float>(i) - 5, 0.01f * static_cast<float>(k) - 5});
  test.add(0, Pose3(Eigen::Translation3d(0.01, 0.01, 0.01)), makeScan(points));
  const auto tree = readLogOdds(write(test.map).at(0));
  ASSERT_TRUE(tree);
  for (double y = -4.9; y < 5; y += 0.2) EXPECT_EQ(cellAt(*tree, 5.11, y, 1.1), Cell::kOccupied);
  for (double x = 0.1; x < 4.8; x += 0.2) EXPECT_EQ(cellAt(*tree, x, 0.1, 0.1), Cell::kFree);
}

TEST(OctoMap, FarCoordinatesStandInTheOffset) {
  TestMap near, far;
  far.map.world_p_origin = {100000, -100000, 0};
  for (TestMap* test : {&near, &far}) test->add(0, planarPose(1, 2, 3), makeScan(wall(4)));
  const auto data = [](const std::string& file) { return file.substr(file.find("\nid OcTree\n")); };
  const auto near_paths = write(near.map), far_paths = write(far.map);
  for (size_t i = 0; i < 2; ++i)
    EXPECT_EQ(data(bytesOf(near_paths[i])), data(bytesOf(far_paths[i])));
}

TEST(OctoMap, RefusesInvalidMapsAndMissingFolders) {
  TestMap test;
  const std::string folder = freshFolder();
  EXPECT_THAT(errorOf([&] { OctoMap().exportMap(test.map, folder + "/missing/map"); }),
              HasSubstr(folder + "/missing/map.ot"));
  Pose3 broken = Pose3::Identity();
  broken.linear()(0, 0) = std::nan("");
  test.add(0, broken, makeScan({{1, 0, 0}}));
  EXPECT_THAT(errorOf([&] { OctoMap().exportMap(test.map, folder + "/map"); }),
              HasSubstr("husky1:0"));
  EXPECT_EQ(fileCount(folder), 0u);
}

}  // namespace
}  // namespace lamp
