#include "lamp/maps/Traversability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>

#include <cstring>
#include <map>

#include "TestGround.h"

namespace lamp {
namespace {

using GroundRow = std::map<std::string, float>;

/** The cloud's points by the names of their fields, as PCL reads them. */
std::vector<GroundRow> groundOf(const TestMap& test) {
  const std::string path = Traversability().exportMap(test.map, freshFolder() + "/map").at(0);
  pcl::PCLPointCloud2 cloud;
  EXPECT_EQ(pcl::io::loadPCDFile(path, cloud), 0);
  std::vector<GroundRow> rows(cloud.width * cloud.height);
  for (size_t i = 0; i < rows.size(); ++i)
    for (const auto& field : cloud.fields)
      std::memcpy(&rows[i][field.name], &cloud.data[i * cloud.point_step + field.offset],
                  sizeof(float));
  return rows;
}

TEST(Traversability, ALevelFloorIsEasy) {
  TestMap test;
  GroundWorld world = hall();
  world.addFloor(-0.9, 10.9, -2.9, 2.9, [](double, double) { return 1.75; });
  world.drive({{1, 0, 0.05}, {9, 0, 0.05}}, test);
  size_t inside = 0;
  for (const GroundRow& row : groundOf(test)) {
    if (std::abs(row.at("x") - 5) > 4 || std::abs(row.at("y")) > 2) continue;
    ++inside;
    EXPECT_NEAR(row.at("z"), 0.05, 1e-3);
    EXPECT_NEAR(row.at("slope"), 0, 0.1);
    EXPECT_NEAR(row.at("step"), 0, 1e-3);
    EXPECT_NEAR(row.at("clearance"), 1.7, 0.2);
    EXPECT_LT(row.at("cost"), 0.05);
    EXPECT_EQ(row.at("storey"), 0);
  }
  EXPECT_NEAR(static_cast<double>(inside), 40 * 20, 60);
}

TEST(Traversability, ARampIsAsSteepAsItIs) {
  TestMap test;
  const TwoStoreys building;
  building.drive(test);
  size_t on_ramp = 0, above = 0;
  for (const GroundRow& row : groundOf(test)) {
    above += row.at("storey") == 1;
    if (row.at("x") < 21 || row.at("x") > building.top - 1 || std::abs(row.at("y")) > 0.4) continue;
    ++on_ramp;
    EXPECT_NEAR(row.at("z"), building.onRamp(row.at("x")), 0.04) << row.at("x");
    EXPECT_NEAR(row.at("slope"), kRampSlopeDeg, 2) << row.at("x");
    EXPECT_LT(row.at("step"), 0.08);
    EXPECT_GE(row.at("cost"), 0.4);
    EXPECT_LT(row.at("cost"), 0.7);
  }
  EXPECT_GT(on_ramp, 200u);
  EXPECT_GT(above, 500u);
}

TEST(Traversability, AStepIsAsHighAsItIs) {
  TestMap test;
  GroundWorld world;
  world.addFloor(-1, 5, -2, 2, [](double x, double) { return x < 2.99 ? 0.05 : 0.17; });
  world.drive({{0, 0, 0.05}, {2, 0, 0.05}}, test);
  double greatest = 0;
  for (const GroundRow& row : groundOf(test))
    if (std::abs(row.at("y")) < 1 && std::abs(row.at("x") - 3) < 0.3)
      greatest = std::max<double>(greatest, row.at("step"));
  // The plane through both levels takes some of it.
  EXPECT_GT(greatest, 0.06);
  EXPECT_LT(greatest, 0.13);
}

TEST(Traversability, WhereARobotDoesNotFitNoneGets) {
  TestMap test;
  GroundWorld world = hall();
  world.addFloor(5, 6, 1, 2, [](double, double) { return 0.9; });  // a table
  world.drive({{1, 0, 0.05}, {9, 0, 0.05}}, test);
  size_t under = 0;
  for (const GroundRow& row : groundOf(test)) {
    if (std::abs(row.at("x") - 5.5) > 0.3 || std::abs(row.at("y") - 1.1) > 0.1) continue;
    ++under;
    EXPECT_EQ(row.at("cost"), 1);
    EXPECT_NEAR(row.at("clearance"), 0.85, 0.2);
  }
  EXPECT_GT(under, 0u);
}

TEST(Traversability, WithoutGroundTheCloudIsEmpty) {
  TestMap test;
  test.add(0, Pose3::Identity(), makeScan({{1, 0, 0}}));
  EXPECT_TRUE(groundOf(test).empty());
}

}  // namespace
}  // namespace lamp
