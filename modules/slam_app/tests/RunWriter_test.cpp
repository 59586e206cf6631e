#include "lamp/slam_app/RunWriter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "TemporaryFolder.h"
#include "TestTeam.h"
#include "lamp/core/Files.h"

namespace lamp {
namespace {

using namespace test;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/** A small team's run, written. */
struct WrittenRun {
  WrittenRun(const std::string& exporters, const std::string& ply_voxel_m) {
    Station station("[pipeline]\ncandidates =\nexporters = " + exporters +
                    "\n[lamp::Ply]\nvoxel_m = " + ply_voxel_m + "\n");
    RobotTable robots;
    robots.add("husky");
    robots.add("spot");
    Team().sendTo(station.base);
    const RunFolder folder = RunFolder::create(root);
    not_written = writeRun(folder, {station.config, robots, station.base, {}, {}},
                           station.config.makeMapExporters(), station.timer,
                           [](double, const std::string&) {});
  }
  bool has(const std::string& file) const { return std::filesystem::exists(root + "/" + file); }

  const std::string root = freshFolder();
  std::vector<std::string> not_written;
};

TEST(RunWriter, AnExporterThatFailsTakesNothingElseWithIt) {
  const WrittenRun run("Ply, Pcd", "1e-9");  // voxels too small to be numbered
  const auto failure = AllOf(HasSubstr("Ply: "), HasSubstr("raise voxel_m"));
  EXPECT_THAT(run.not_written, ElementsAre(failure, failure));  // a map a robot
  for (const char* file : {"maps/map.pcd", "maps/map_2.pcd", "graph.g2o", "trajectories/spot.tum"})
    EXPECT_TRUE(run.has(file)) << file;
  const auto summary = nlohmann::json::parse(readTextFile(run.root + "/summary.json"));
  EXPECT_EQ(summary["not_written"], nlohmann::json(run.not_written));
}

TEST(RunWriter, SaysNothingWhereNothingFailed) {
  const WrittenRun run("Ply, Pcd", "0.05");
  EXPECT_TRUE(run.not_written.empty());
  const auto summary = nlohmann::json::parse(readTextFile(run.root + "/summary.json"));
  EXPECT_TRUE(summary["not_written"].empty());
}

TEST(RunWriter, AFileThatCannotBeWrittenTakesNothingElseWithIt) {
  const std::string root = freshFolder();
  const RunFolder folder = RunFolder::create(root);
  std::filesystem::create_directories(root + "/graph.g2o/in the way");
  std::filesystem::create_directories(root + "/trajectories/husky.tum/in the way");
  Station station(teamIni());
  RobotTable robots;
  robots.add("husky");
  robots.add("spot");
  Team().sendTo(station.base);
  const auto failures =
      writeRun(folder, {station.config, robots, station.base, {}, {}},
               station.config.makeMapExporters(), station.timer, [](double, const std::string&) {});
  EXPECT_THAT(failures, ElementsAre(HasSubstr("graph.g2o'"), HasSubstr("husky.tum'")));
  for (const char* file :
       {"graph.graph", "trajectories/husky.keyframes.tum", "trajectories/spot.tum", "summary.json"})
    EXPECT_TRUE(std::filesystem::is_regular_file(root + "/" + file)) << file;
}

}  // namespace
}  // namespace lamp
