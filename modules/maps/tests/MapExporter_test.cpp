#include "lamp/maps/MapExporter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "TestMaps.h"

namespace lamp {
namespace {

TEST(MapExporter, ClassesAreMadeByNameAndReadTheirOptions) {
  registerAllClasses_lamp_maps();
  EXPECT_THAT(stageClasses(CLASS_ID(MapExporter)),
              testing::IsSupersetOf({"OccupancyGrid", "OctoMap", "Pcd", "Picture", "Ply", "Scene3d",
                                     "SimpleMap", "Traversability"}));
  Faults faults;
  const Ini ini = Ini::fromText(
      "[lamp::Ply]\nvoxel_m = 0.5\n[lamp::Pcd]\nvoxel_m = 0\n"
      "[lamp::Scene3d]\nvoxel_m = 0.1\n[lamp::Picture]\nsize_px = 400\n",
      "test.ini", faults);
  TestMap test;
  test.add(0, Pose3::Identity(), makeScan({{1, 1, 1}}));
  const std::string folder = freshFolder();
  size_t files = 0;
  for (const char* name : {"Ply", "Pcd", "OctoMap", "Picture"}) {
    const auto stage =
        makeStage<MapExporter>(StageName::parse(name), "exporter", "test.ini:1", ini, faults);
    ASSERT_TRUE(stage) << name;
    files += stage->exportMap(test.map, folder + "/map").size();
  }
  EXPECT_TRUE(faults.empty());
  EXPECT_EQ(files, 5u);
  EXPECT_EQ(fileCount(folder), 5u);
}

TEST(MapExporter, OptionsOutOfRangeAreFaults) {
  registerAllClasses_lamp_maps();
  Faults faults;
  const Ini ini =
      Ini::fromText("[lamp::Picture]\nprob_hit = 1.0\nsize_px = 0\n", "test.ini", faults);
  makeStage<MapExporter>(StageName::parse("Picture"), "exporter", "test.ini:1", ini, faults);
  EXPECT_EQ(faults.list().size(), 2u);
}

TEST(MapExporter, TheFirstEightRobotColoursDiffer) {
  std::set<std::tuple<int, int, int>> colors;
  for (uint16_t robot = 0; robot < 8; ++robot) {
    const Color color = robotColor(RobotId{robot});
    colors.insert({color.r, color.g, color.b});
  }
  EXPECT_EQ(colors.size(), 8u);
  EXPECT_EQ(robotColor(RobotId{8}).r, robotColor(RobotId{0}).r);
}

}  // namespace
}  // namespace lamp
