// Real recordings with the inis that are shipped for them. Skipped where a recording is missing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>

#include <cmath>
#include <set>

#include "Experiment.h"
#include "Measures.h"
#include "lamp/evaluation/Relations.h"

namespace lamp::test {

using namespace evaluation;
namespace {

constexpr double kDegree = M_PI / 180.0;

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
  const std::vector<std::string> common = {ini("sena.ini"), "--set", "pipeline.exporters=Ply",
                                           "--set", "pipeline.odometry=RecordedOdometry"};
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

TEST(Recordings, AcesBeatsItsOdometryFourTimes) {
  const std::string folder = dataFolder() + "/radish2d/";
  if (!std::filesystem::exists(folder + "aces.rawlog"))
    GTEST_SKIP() << folder << " is missing; set LAMP_DATA to the folder of recordings";
  const Experiment experiment;
  const auto mapped = [&](const std::string& odometry) {
    const LampResult end =
        experiment.run({ini("aces.ini"), folder + "aces.rawlog", "--set",
                        "pipeline.exporters=", "--set", "pipeline.odometry=" + odometry},
                       odometry);
    EXPECT_EQ(end.exit_code, 0) << end.err;
    return experiment.result(odometry);
  };
  const FinishedRun run = mapped("RecordedOdometry");
  ASSERT_EQ(run.summary()["robots"][0]["scans"], 7374);

  const std::string stamps = folder + "aces.scan_stamps.txt";
  const auto relations = readRelations(folder + "aces.relations");
  const auto errorsOf = [&](const std::vector<StampedPose>& trajectory) {
    return relationErrors(withRelationStamps(trajectory, stamps), relations);
  };
  const RelationErrors optimised = errorsOf(run.trajectory("aces"));
  const RelationErrors odometry = errorsOf(run.odometry("aces"));
  const auto record = [&](const std::string& name, RelationError RelationErrors::*part) {
    const auto text = [](double number) { return std::to_string(number); };
    RecordProperty(name + "_relations", static_cast<int>((optimised.*part).translation_m.count));
    RecordProperty(name + "_m", text((optimised.*part).translation_m.mean));
    RecordProperty(name + "_deg", text((optimised.*part).rotation_deg.mean));
    RecordProperty(name + "_odometry_m", text((odometry.*part).translation_m.mean));
  };
  record("below_5_s", &RelationErrors::below_5_s);
  record("from_5_s", &RelationErrors::from_5_s);
  record("all", &RelationErrors::all);

  const double before = odometry.all.translation_m.mean;
  EXPECT_EQ(optimised.without_pose, 0u);
  EXPECT_NEAR(before, 0.55, 0.03) << "what data-notes.md says of odometry alone";
  EXPECT_LT(optimised.all.translation_m.mean, before / 4);
  EXPECT_LT(optimised.from_5_s.translation_m.mean, odometry.from_5_s.translation_m.mean / 4);

  const FinishedRun by_lidar = mapped("LidarOdometry,RecordedOdometry");
  EXPECT_LT(errorsOf(by_lidar.odometry("aces")).all.translation_m.mean, before / 2)
      << "the lidar's odometry";
  EXPECT_LT(errorsOf(by_lidar.trajectory("aces")).all.translation_m.mean,
            optimised.all.translation_m.mean);
}

}  // namespace
}  // namespace lamp::test
