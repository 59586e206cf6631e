// Start poses in the coordinates of a national grid: nothing may become coarser than near the
// origin.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/graphs/CNetworkOfPoses.h>

#include "Experiment.h"
#include "G2oFile.h"

namespace lamp::test {
namespace {

using testing::HasSubstr;

// What doubles hold exactly, so that the results can be, too.
const Eigen::Vector3d kNear(200.25, 345.5, 312), kGrid(431000, 5412000, 0);

/** What of a map's file follows its header. */
std::string dataOf(const std::string& path, const std::string& end_of_header) {
  const std::string bytes = readFile(path);
  const size_t end = bytes.find(end_of_header);
  EXPECT_NE(end, std::string::npos) << path;
  return bytes.substr(end);
}

/** The same recordings of two robots, mapped near the origin and far away from it. */
class WorldCoordinates : public testing::Test {
 protected:
  WorldCoordinates() {
    const BoxWorld world = BoxWorld::building(7);
    for (const auto& [name, route] :
         {std::pair<std::string, std::vector<Eigen::Vector2d>>{"A", {{3, 3}, {17, 3}}},
          {"B", {{17, 9}, {17, 3}, {10, 3}}}}) {
      SyntheticRobot robot;
      robot.name = name;
      robot.route = route;
      const Recording recording = robot.record3d(world);
      starts_[name] = recording.truth.front().pose;
      rawlogs_.push_back(experiment_.rawlog(name + ".rawlog", recording.objects));
    }
    map("near", kNear);
    map("far", kNear + kGrid);
  }

  void map(const std::string& name, const Eigen::Vector3d& shift) {
    std::string sections;
    for (auto [robot, pose] : starts_) sections += startSection(robot, pose.pretranslate(shift));
    end_ =
        experiment_.run({experiment_.file(name + ".ini", iniFor3d("Ply, Pcd, OctoMap", sections)),
                         rawlogs_[0], rawlogs_[1]},
                        name);
    EXPECT_EQ(end_.exit_code, 0) << end_.err;
  }

  std::map<std::string, Pose3> starts_;
  std::vector<std::string> rawlogs_;
  Experiment experiment_;
  LampResult end_;
  const FinishedRun near_ = experiment_.result("near"), far_ = experiment_.result("far");
};

TEST_F(WorldCoordinates, TrajectoriesAndGraphAreInTheWorld) {
  for (const char* robot : {"A", "B"})
    for (const auto& [here, there] : {std::pair{near_.trajectory(robot), far_.trajectory(robot)},
                                      {near_.odometry(robot), far_.odometry(robot)},
                                      {near_.keyNodes(robot), far_.keyNodes(robot)}}) {
      ASSERT_EQ(here.size(), there.size());
      for (size_t i = 0; i < here.size(); ++i) {
        const Eigen::Vector3d shift = there[i].pose.translation() - here[i].pose.translation();
        EXPECT_NEAR((shift - kGrid).norm(), 0, 1e-8);
        EXPECT_TRUE(there[i].pose.linear().isApprox(here[i].pose.linear(), 1e-8));
      }
    }
  const G2oFile here = G2oFile::read(near_.folder().graphG2o()),
                there = G2oFile::read(far_.folder().graphG2o());
  ASSERT_EQ(here.vertices.size(), there.vertices.size());
  for (const auto& [id, pose] : here.vertices)
    EXPECT_NEAR((there.vertices.at(id).translation() - pose.translation() - kGrid).norm(), 0, 1e-8);
  mrpt::graphs::CNetworkOfPoses3DInf graph;
  graph.loadFromTextFile(far_.folder().graphMrpt(), false);
  EXPECT_NEAR(graph.nodes.at(0).x(), there.vertices.at(0).translation().x(), 1e-6);
}

TEST_F(WorldCoordinates, MapsAreAsFineAsNearTheOriginAndStateTheirOffset) {
  for (const auto& [extension, end_of_header] : {std::pair{".ply", "end_header\n"},
                                                 {".pcd", "DATA binary\n"},
                                                 {".bt", "\ndata\n"},
                                                 {".ot", "\ndata\n"}}) {
    const std::string here = near_.folder().mapStem(0) + extension,
                      there = far_.folder().mapStem(0) + extension;
    EXPECT_TRUE(dataOf(here, end_of_header) == dataOf(there, end_of_header)) << extension;
    EXPECT_GT(dataOf(there, end_of_header).size(), 1000u) << extension;
    EXPECT_THAT(readFile(there).substr(0, 300), HasSubstr("offset 431000 5412000 0\n"));
  }
  EXPECT_EQ(far_.summary()["components"][0]["map_offset_m"], nlohmann::json({431000, 5412000, 0}));
  EXPECT_EQ(near_.summary()["components"][0]["map_offset_m"], nlohmann::json({0, 0, 0}));
  EXPECT_THAT(end_.out, HasSubstr("431000 5412000 0 m"));
  EXPECT_THAT(readFile(far_.folder().config()), HasSubstr("431203.25 5412348.5 312"));
}

}  // namespace
}  // namespace lamp::test
