// What every map exporter must hold to, whoever wrote it.
#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "StageSuite.h"
#include "TestMaps.h"

namespace lamp {
namespace {

using test::makeDefault;
using test::testName;

std::vector<std::string> exporters() {
  registerAllClasses_lamp_core();
  registerAllClasses_lamp_maps();
  return stageClasses(CLASS_ID(MapExporter));
}

/** Two key nodes of two robots between walls on a floor, with tracks and a loop closure. */
void furnish(TestMap& test) {
  std::vector<Eigen::Vector3f> walls;
  for (int i = 0; i < 60; ++i) {
    const float x = 0.1f * static_cast<float>(i) - 3;
    for (const float y : {-2.0f, 2.0f})
      walls.emplace_back(x, y, 0.05f * static_cast<float>(i % 20));
    for (float y = -1; y < 1; y += 0.1f) walls.emplace_back(x, y, -0.1f);
  }
  test.add(0, planarPose(0, 0, 0), makeScan(walls, {0, 0, 0.3}));
  test.add(1, planarPose(2, 0.5, 0.3), makeScan(walls, {0.1, 0, 0.3}));
  test.addTrack(0, {{0, 0}, {1, 0}});
  test.addTrack(1, {{2, 0.5}, {3, 0.5}});
  test.map.loops.push_back({{0, 0, 0}, {2, 0.5, 0}, Verdict::kInlier});
}

/** The names of all files of a folder, with their bytes. */
std::map<std::string, std::string> filesIn(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files[entry.path().filename()] = bytesOf(entry.path());
  return files;
}

class AnyMapExporter : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<MapExporter> make() const { return makeDefault<MapExporter>(GetParam()); }

  /** The files that a map becomes. */
  std::map<std::string, std::string> exported(const ComponentMap& map) {
    const std::string folder = freshFolder();
    exporter->exportMap(map, folder + "/map");
    return filesIn(folder);
  }

  const std::shared_ptr<MapExporter> exporter = make();
};
INSTANTIATE_TEST_SUITE_P(All, AnyMapExporter, testing::ValuesIn(exporters()), testName);

TEST_P(AnyMapExporter, NamesExactlyTheFilesThatItWrites) {
  TestMap test;
  furnish(test);
  const std::string folder = freshFolder();
  const std::vector<std::string> paths = exporter->exportMap(test.map, folder + "/map");
  EXPECT_FALSE(paths.empty());
  EXPECT_EQ(fileCount(folder), paths.size());
  for (const std::string& path : paths) {
    EXPECT_EQ(path.rfind(folder + "/map.", 0), 0u) << path;
    EXPECT_GT(std::filesystem::file_size(path), 0u) << path;
  }
}

TEST_P(AnyMapExporter, ShowsWhereThePosesAre) {
  TestMap here, there;
  furnish(here);
  furnish(there);
  there.map.key_nodes[1].world_T_base = planarPose(2, 1.5, -0.3);
  EXPECT_NE(exported(here.map), exported(there.map));
}

TEST_P(AnyMapExporter, WritesTheSameBytesTwiceAndKeepsNothingOfOtherMaps) {
  TestMap test, other;
  furnish(test);
  other.add(0, planarPose(50, 50, 1), makeScan({{1, 2, 3}, {4, 5, 6}}));
  const auto once = exported(test.map);
  exported(other.map);
  EXPECT_EQ(exported(test.map), once);
  const std::string folder = freshFolder();
  make()->exportMap(test.map, folder + "/map");
  EXPECT_EQ(filesIn(folder), once);
}

TEST_P(AnyMapExporter, SurvivesMapsWithHardlyAnything) {
  TestMap nothing, blind, point;
  blind.add(0, Pose3::Identity(), makeScan({}));
  point.add(0, Pose3::Identity(), makeScan({{1, 0, 0}}));
  for (const TestMap* test : {&nothing, &blind, &point}) EXPECT_FALSE(exported(test->map).empty());
}

TEST_P(AnyMapExporter, LeavesOutPointsThatAreNoNumbers) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  TestMap clean, broken;
  clean.add(0, Pose3::Identity(), makeScan({{1, 0, 0}, {0, 2, 0}, {3, 3, 1}}));
  broken.add(0, Pose3::Identity(),
             makeScan({{1, 0, 0}, {nan, 0, 0}, {0, 2, 0}, {0, nan, nan}, {3, 3, 1}}));
  EXPECT_EQ(exported(broken.map), exported(clean.map));
}

TEST_P(AnyMapExporter, LeavesTheScansAsTheyAre) {
  TestMap test;
  furnish(test);
  const Scan before = *test.map.key_nodes[0].scan;
  exported(test.map);
  const Scan& after = *test.map.key_nodes[0].scan;
  EXPECT_EQ(before.points, after.points);
  EXPECT_EQ(before.sensor, after.sensor);
  EXPECT_EQ(before.intensity, after.intensity);
}

TEST_P(AnyMapExporter, SaysOfEachFileThatTheDiskIsFull) {
  TestMap test;
  furnish(test);
  for (const auto& [name, bytes] : exported(test.map)) {
    const std::string folder = freshFolder();
    std::filesystem::create_symlink("/dev/full", folder + "/" + name);
    const std::string error = errorOf([&] { exporter->exportMap(test.map, folder + "/map"); });
    EXPECT_NE(error.find(folder + "/" + name), std::string::npos) << error;
    EXPECT_NE(error.find("No space left"), std::string::npos) << error;
  }
}

TEST_P(AnyMapExporter, NamesAFolderThatIsNotThereAndLeavesNothing) {
  TestMap test;
  furnish(test);
  const std::string folder = freshFolder();
  const std::string stem = folder + "/missing/map";
  EXPECT_NE(errorOf([&] { exporter->exportMap(test.map, stem); }).find(stem), std::string::npos);
  EXPECT_EQ(fileCount(folder), 0u);
}

}  // namespace
}  // namespace lamp
