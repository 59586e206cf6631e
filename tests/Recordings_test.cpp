// Real recordings with the inis that are shipped for them. Skipped where a recording is missing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "Experiment.h"
#include "Measures.h"

namespace lamp::test {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kForever = std::numeric_limits<double>::infinity();

std::string ini(const std::string& name) {
  return LAMP_SOURCE_DIR "/ini/" + name;
}

/** Number of 0.1 m cells that the map's points fill: walls that are seen double fill more. */
size_t filledCells(const FinishedRun& run) {
  mrpt::maps::CSimplePointsMap cloud;
  if (!cloud.loadFromPlyFile(run.folder().mapStem(0) + ".ply"))
    throw std::runtime_error("no point cloud in " + run.folder().root());
  const auto &x = cloud.getPointsBufferRef_x(), &y = cloud.getPointsBufferRef_y();
  std::vector<Eigen::Vector3f> points;
  for (size_t i = 0; i < x.size(); ++i) points.emplace_back(x[i], y[i], 0.0f);
  return occupiedCells(points, 0.1);
}

TEST(Recordings, SenaClosesItsLoop) {
  if (mrptRecording("2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog").empty())
    GTEST_SKIP() << "the recording is in Debian's package mrpt-common";
  const Experiment experiment;
  const std::vector<std::string> common = {ini("sena.ini"), "--set", "pipeline.exporters=Ply"};
  const LampResult end = experiment.run(common);
  ASSERT_EQ(end.exit_code, 0) << end.err;
  auto without_loops = common;
  without_loops.insert(without_loops.end(), {"--set", "pipeline.candidates="});
  ASSERT_EQ(experiment.run(without_loops, "odometry").exit_code, 0);

  const FinishedRun run = experiment.result();
  EXPECT_EQ(run.summary()["planar"], true);
  EXPECT_EQ(run.summary()["components"].size(), 1u);
  EXPECT_EQ(run.summary()["robots"][0]["scans"], 225) << "224 pairs, and a frame before them";
  EXPECT_GE(run.summary()["loops"]["inliers"], 200);
  int widest = 0;
  for (const auto& [from, to] : inlierLoops(run.loops()))
    widest = std::max(widest, std::abs(indexOf(to) - indexOf(from)));
  EXPECT_GT(widest, 50) << "the end of the way is joined with its beginning";

  const FinishedRun odometry = experiment.result("odometry");
  EXPECT_EQ(odometry.summary()["loops"]["attempts"], 0);
  const size_t cells = filledCells(run), cells_of_odometry = filledCells(odometry);
  RecordProperty("filled_cells", static_cast<int>(cells));
  RecordProperty("filled_cells_odometry", static_cast<int>(cells_of_odometry));
  EXPECT_LT(static_cast<double>(cells), 0.85 * static_cast<double>(cells_of_odometry));
}

/** B's start in A's frame, from a lidar-inertial odometry over both; good to 0.1 m and 1 degree. */
Pose3 knownStartOfB() {
  Vector6d pose;
  pose << 3.457, 8.487, 0.093, 150.11 * kDegree, 3.78 * kDegree, -5.53 * kDegree;
  return poseFromYawPitchRoll(pose);
}

/** 0.5 m and 5 degrees off, each in a direction of its own. */
class BalmIndoor : public testing::TestWithParam<std::pair<Eigen::Vector3d, Eigen::Vector3d>> {};

TEST_P(BalmIndoor, JoinsFromAWrongStart) {
  const std::string folder = dataFolder() + "/balm_indoor/";
  if (!std::filesystem::exists(folder + "robotB.rawlog"))
    GTEST_SKIP() << folder << " is missing; set LAMP_DATA to the folder of recordings";
  Vector6d error;
  error << 0.5 * GetParam().first.normalized(), 5 * kDegree * GetParam().second.normalized();
  const std::string section = startSection("robotB", knownStartOfB() * expSE3(error));
  const std::string start = section.substr(section.find("start_pose"));
  const Experiment experiment;
  const LampResult end = experiment.run(
      {ini("balm_indoor.ini"), folder + "robotA.rawlog", folder + "robotB.rawlog", "--set",
       "robot.robotB." + start.substr(0, start.size() - 1), "--set", "pipeline.exporters="});
  ASSERT_EQ(end.exit_code, 0) << end.err;

  const FinishedRun run = experiment.result();
  EXPECT_EQ(run.summary()["components"].size(), 1u);
  std::set<std::string> from_places, to_places;
  for (const auto& [from, to] : inlierLoops(run.loops())) {
    if (robotOf(from) == robotOf(to)) continue;
    from_places.insert(from);
    to_places.insert(to);
  }
  EXPECT_GE(from_places.size(), 3u);
  EXPECT_GE(to_places.size(), 3u);
  const Pose3 deviation = knownStartOfB().inverse() * run.startOf("robotB", "robotA");
  RecordProperty("deviation_m", std::to_string(deviation.translation().norm()));
  RecordProperty("deviation_deg", std::to_string(rotationAngle(deviation) / kDegree));
  EXPECT_LT(deviation.translation().norm(), 0.15);
  EXPECT_LT(rotationAngle(deviation), 1.5 * kDegree);
}

using Direction = Eigen::Vector3d;
INSTANTIATE_TEST_SUITE_P(FiveStarts, BalmIndoor,
                         testing::Values(std::pair(Direction(1, 0, 0), Direction(0, 0, 1)),
                                         std::pair(Direction(-1, 0, 0), Direction(0, 0, -1)),
                                         std::pair(Direction(0, 1, 0), Direction(1, 0, 0)),
                                         std::pair(Direction(0, -1, 0.5), Direction(0, -1, 0)),
                                         std::pair(Direction(1, 1, -1), Direction(1, 1, 1))));

/** The trajectory with the stamps that the relations use, which are not those of the rawlog. */
std::vector<StampedPose> withTrueStamps(std::vector<StampedPose> trajectory,
                                        const std::string& scan_stamps) {
  std::ifstream file(scan_stamps);
  size_t place = 0;
  for (std::string line; std::getline(file, line);) {
    size_t number = 0;
    double true_stamp = 0, rawlog_stamp = 0;
    if (!(std::istringstream(line) >> number >> true_stamp >> rawlog_stamp)) continue;  // comment
    if (place == trajectory.size()) break;
    if (std::abs(trajectory[place].stamp - rawlog_stamp) > 1e-4) continue;
    trajectory[place++].stamp = true_stamp;
  }
  if (place != trajectory.size()) throw std::runtime_error("stamps that are not in " + scan_stamps);
  return trajectory;
}

TEST(Recordings, AcesBeatsItsOdometryFourTimes) {
  const std::string folder = dataFolder() + "/radish2d/";
  if (!std::filesystem::exists(folder + "aces.rawlog"))
    GTEST_SKIP() << folder << " is missing; set LAMP_DATA to the folder of recordings";
  const Experiment experiment;
  const LampResult end =
      experiment.run({ini("aces.ini"), folder + "aces.rawlog", "--set", "pipeline.exporters="});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  const FinishedRun run = experiment.result();
  EXPECT_EQ(run.summary()["robots"][0]["scans"], 7374);

  const std::string stamps = folder + "aces.scan_stamps.txt";
  const auto relations = readRelations(folder + "aces.relations");
  const auto optimised = withTrueStamps(run.trajectory("aces"), stamps);
  const auto odometry = withTrueStamps(run.odometry("aces"), stamps);
  const auto record = [&](const std::string& name, double from, double to) {
    const RelationError error = relationError(optimised, relations, from, to);
    RecordProperty(name + "_relations", static_cast<int>(error.relations));
    RecordProperty(name + "_m", std::to_string(error.metres));
    RecordProperty(name + "_deg", std::to_string(error.radians / kDegree));
    RecordProperty(name + "_odometry_m",
                   std::to_string(relationError(odometry, relations, from, to).metres));
  };
  record("below_5_s", 0, 5);
  record("from_5_s", 5, kForever);
  record("all", 0, kForever);

  const RelationError before = relationError(odometry, relations, 0, kForever);
  EXPECT_NEAR(before.metres, 0.55, 0.03) << "what data-notes.md says of odometry alone";
  EXPECT_LT(relationError(optimised, relations, 0, kForever).metres, before.metres / 4);
  EXPECT_LT(relationError(optimised, relations, 5, kForever).metres,
            relationError(odometry, relations, 5, kForever).metres / 4);
}

}  // namespace
}  // namespace lamp::test
