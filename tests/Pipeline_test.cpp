// The main way from recordings to a run folder, through the real program, on worlds with known
// truth.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Experiment.h"
#include "Measures.h"

namespace lamp::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kDegree = M_PI / 180.0;
constexpr unsigned kWorldSeed = 7;

SyntheticRobot robot(const std::string& name, const std::vector<Eigen::Vector2d>& route,
                     unsigned seed) {
  SyntheticRobot result;
  result.name = name;
  result.route = route;
  result.seed = seed;
  return result;
}

/** 0.5 m and 5 degrees off. */
Pose3 wrongStart(const Pose3& start) {
  Vector6d error;
  error << 0.3, -0.4, 0, 0, 0, 5 * kDegree;
  return start * expSE3(error);
}

/** Robots A and B in one building; they drive the same corridor in opposite directions. */
class TwoRobots : public testing::Test {
 protected:
  TwoRobots() {
    const BoxWorld world = BoxWorld::building(kWorldSeed);
    a_ = robot("A", ringRoute(), 1).record3d(world);
    b_ = robot("B", oppositeRoute(), 2).record3d(world);
    rawlogs_ = {experiment_.rawlog("A.rawlog", a_.objects),
                experiment_.rawlog("B.rawlog", b_.objects)};
  }

  LampResult run(const std::string& ini, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {experiment_.file("experiment.ini", ini), rawlogs_[0],
                                          rawlogs_[1]};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return experiment_.run(arguments);
  }

  std::string startSections() const {
    return startSection("A", a_.truth.front().pose) +
           startSection("B", wrongStart(b_.truth.front().pose));
  }

  Recording a_, b_;
  Experiment experiment_;
  std::vector<std::string> rawlogs_;
};

void expectInPlane(const std::vector<StampedPose>& trajectory) {
  for (const StampedPose& pose : trajectory) {
    const Eigen::Quaterniond rotation(pose.pose.linear());
    ASSERT_EQ(pose.pose.translation().z(), 0);
    ASSERT_EQ(rotation.x(), 0);
    ASSERT_EQ(rotation.y(), 0);
  }
}

class Planar : public testing::TestWithParam<bool> {};

TEST_P(Planar, LoopClosesInThePlane) {
  const bool pairs = GetParam();
  const BoxWorld world = BoxWorld::building(kWorldSeed);
  const SyntheticRobot driver = robot("A", ringRoute(), 3);
  const Recording recording = pairs ? driver.recordPlanarPairs(world) : driver.recordPlanar(world);
  const Experiment experiment;
  const LampResult end = experiment.run({experiment.file("planar.ini", iniForPlanar()),
                                         experiment.rawlog("A.rawlog", recording.objects), "--set",
                                         "pipeline.odometry=RecordedOdometry"});
  ASSERT_EQ(end.exit_code, 0) << end.err;

  const FinishedRun run = experiment.result();
  EXPECT_EQ(run.summary()["planar"], true);
  EXPECT_EQ(run.summary()["components"].size(), 1u);
  const double before = ateFromFirst(run.odometry("A"), recording.truth);
  const double after = ateFromFirst(run.trajectory("A"), recording.truth);
  RecordProperty("ate_odometry_m", std::to_string(before));
  RecordProperty("ate_optimised_m", std::to_string(after));
  EXPECT_GT(before, 0.3);
  EXPECT_LT(after, before / 2);
  EXPECT_EQ(run.trajectory("A").size(), recording.truth.size());
  for (const auto& trajectory : {run.trajectory("A"), run.odometry("A"), run.keyNodes("A")})
    expectInPlane(trajectory);
  EXPECT_THAT(readFile(run.folder().graphG2o()), HasSubstr("VERTEX_SE2 "));
  EXPECT_THAT(readFile(run.folder().graphG2o()), Not(HasSubstr("SE3")));
}

INSTANTIATE_TEST_SUITE_P(RawlogFormats, Planar, testing::Bool(), [](const auto& format) {
  return format.param ? "ActionFramePairs" : "Observations";
});

TEST_F(TwoRobots, JoinFromAWrongStartPose) {
  const LampResult end =
      run(iniFor3d("", startSections()), {"--set", "pipeline.odometry=RecordedOdometry"});
  ASSERT_EQ(end.exit_code, 0) << end.err;

  const FinishedRun result = experiment_.result();
  const auto summary = result.summary();
  ASSERT_EQ(summary["components"].size(), 1u);
  EXPECT_EQ(summary["components"][0]["robots"], nlohmann::json({"A", "B"}));
  EXPECT_EQ(summary["components"][0]["anchor"], "A:0");
  EXPECT_EQ(summary["interrupted"], false);
  EXPECT_GE(summary["components"][0]["inliers_between_robots"], 3);

  const Pose3 truth = a_.truth.front().pose.inverse() * b_.truth.front().pose;
  const Pose3 error = truth.inverse() * result.startOf("B", "A");
  EXPECT_LT(error.translation().norm(), 0.15);
  EXPECT_LT(rotationAngle(error), 1.5 * kDegree);
  for (const auto& [name, recording] : {std::pair{"A", a_}, std::pair{"B", b_}}) {
    const double before = ateFromFirst(result.odometry(name), recording.truth);
    EXPECT_GT(before, 0.3) << name;
    EXPECT_LT(ateFromFirst(result.trajectory(name), recording.truth), before / 2) << name;
    EXPECT_EQ(result.trajectory(name).size(), recording.truth.size()) << name;
  }
}

TEST_F(TwoRobots, StaySeparateWithoutLoopsBetweenRobots) {
  const LampResult end =
      run(iniFor3d("Ply, OctoMap", startSections()), {"--set", "pipeline.inter_robot_loops=false"});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("map 1 of 2: A"));
  EXPECT_THAT(end.out, HasSubstr("map 2 of 2: B"));
  EXPECT_THAT(end.out, HasSubstr("2 components: they stay separate maps"));

  const FinishedRun result = experiment_.result();
  const auto components = result.summary()["components"];
  ASSERT_EQ(components.size(), 2u);
  EXPECT_EQ(components[0]["robots"], nlohmann::json({"A"}));
  EXPECT_EQ(components[0]["map"], "maps/map");
  EXPECT_EQ(components[1]["robots"], nlohmann::json({"B"}));
  EXPECT_EQ(components[1]["map"], "maps/map_2");
  for (const char* file : {"maps/map.ply", "maps/map.bt", "maps/map_2.ply", "maps/map_2.bt"})
    EXPECT_TRUE(result.has(file)) << file;
  EXPECT_FALSE(result.has("maps/map_3.ply"));
  for (const auto& [from, to] : inlierLoops(result.loops())) EXPECT_EQ(robotOf(from), robotOf(to));
}

TEST_F(TwoRobots, JoinWithoutStartPoses) {
  const LampResult end = run(iniFor3d());
  ASSERT_EQ(end.exit_code, 0) << end.err;
  const FinishedRun result = experiment_.result();
  const auto summary = result.summary();
  ASSERT_EQ(summary["components"].size(), 1u);
  ASSERT_EQ(summary["optimization"]["frames"].size(), 1u);
  EXPECT_EQ(summary["optimization"]["frames"][0]["joined"], true);
  const Pose3 truth = a_.truth.front().pose.inverse() * b_.truth.front().pose;
  const Pose3 error = truth.inverse() * result.startOf("B", "A");
  EXPECT_LT(error.translation().norm(), 0.15);
  EXPECT_LT(rotationAngle(error), 1.5 * kDegree);
}

TEST_F(TwoRobots, StaySeparateUntilEnoughLoopsAgree) {
  const LampResult end = run(iniFor3d(), {"--set", "lamp::RobotFrames.min_agreeing=1000"});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("A and B: of "));
  EXPECT_THAT(end.out, HasSubstr("1000 are needed"));
  const FinishedRun result = experiment_.result();
  EXPECT_EQ(result.summary()["components"].size(), 2u);
  for (const auto& robot : result.summary()["robots"]) EXPECT_EQ(robot["start_pose_known"], false);
  for (const char* name : {"A", "B"}) {
    const Pose3 first = result.keyNodes(name).front().pose;
    EXPECT_TRUE(first.isApprox(Pose3::Identity(), 1e-6)) << name;
  }
}

TEST_F(TwoRobots, OperatorsActionsAreReplayed) {
  const std::string actions = experiment_.file("actions.csv",
                                               "key_nodes,action,loop_id,robot\n"
                                               "10,ignore,,B\n"
                                               "100000,veto,0,\n"
                                               "100000,veto,100000,\n");
  const LampResult end = run(iniFor3d("", startSections()), {"--actions", actions});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.err, HasSubstr("actions.csv:4: not done"));
  const FinishedRun first = experiment_.result();
  EXPECT_EQ(first.summary()["components"].size(), 2u) << "B is ignored";
  const CsvTable loops = first.loops();
  EXPECT_EQ(loops.rows.at(0)[loops.column("verdict")], "outlier");

  const LampResult again =
      experiment_.run({experiment_.path("experiment.ini"), rawlogs_[0], rawlogs_[1], "--actions",
                       experiment_.path("run/actions.csv"), "--threads", "1"},
                      "again");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  for (const char* name : {"actions.csv", "loops.csv", "verdicts.csv", "graph.g2o"})
    EXPECT_EQ(readFile(experiment_.path("again/" + std::string(name))),
              readFile(experiment_.path("run/" + std::string(name))))
        << name;
}

TEST(RobotsThatNeverMeet, GiveTwoMaps) {
  const Eigen::Vector2d far_away(150, 80);
  const Recording a = robot("A", ringRoute(), 1).record3d(BoxWorld::building(kWorldSeed));
  const Recording b = robot("B", shortRoute(far_away), 2).record3d(BoxWorld::building(8, far_away));
  const Experiment experiment;
  const std::string starts =
      startSection("A", a.truth.front().pose) + startSection("B", b.truth.front().pose);
  const LampResult end = experiment.run({experiment.file("far.ini", iniFor3d("Pcd", starts)),
                                         experiment.rawlog("A.rawlog", a.objects),
                                         experiment.rawlog("B.rawlog", b.objects)});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("stay separate maps"));
  const FinishedRun run = experiment.result();
  ASSERT_EQ(run.summary()["components"].size(), 2u);
  EXPECT_EQ(run.summary()["components"][0]["inliers_between_robots"], 0);
  EXPECT_TRUE(run.has("maps/map.pcd"));
  EXPECT_TRUE(run.has("maps/map_2.pcd"));
  // They share the world frame all the same.
  const Pose3 error = b.truth.front().pose.inverse() * run.keyNodes("B").front().pose;
  EXPECT_LT(error.translation().norm(), 1e-6);
}

TEST(OneRobot, IsNamedByItsFileAndMapped) {
  const Recording recording =
      robot("left over/not a name", shortRoute(), 1).record3d(BoxWorld::building(kWorldSeed));
  for (const auto& object : recording.objects) {
    auto& observation = dynamic_cast<mrpt::obs::CObservation&>(*object);
    observation.sensorLabel =
        observation.sensorLabel.substr(observation.sensorLabel.rfind('/') + 1);
  }
  const Experiment experiment;
  const LampResult end =
      experiment.run({experiment.file("one.ini", iniFor3d()),
                      experiment.rawlog("my robot.1.rawlog", recording.objects)});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("map 1 of 1: my_robot_1"));
  EXPECT_THAT(end.out, Not(HasSubstr("separate")));
  const FinishedRun run = experiment.result();
  EXPECT_EQ(run.trajectory("my_robot_1").size(), recording.truth.size());
  EXPECT_LT(ateFromFirst(run.trajectory("my_robot_1"), recording.truth), 0.2);
}

TEST(OneRecording, OfTwoRobotsIsSplitByLabel) {
  const BoxWorld world = BoxWorld::building(kWorldSeed);
  SyntheticRobot later = robot("B", oppositeRoute(), 2);
  later.start_stamp += 5;
  const Recording a = robot("A", shortRoute(), 1).record3d(world), b = later.record3d(world);
  Objects both = a.objects;
  both.insert(both.end(), b.objects.begin(), b.objects.end());
  std::stable_sort(both.begin(), both.end(), [](const auto& left, const auto& right) {
    const auto stamp = [](const auto& object) {
      return dynamic_cast<const mrpt::obs::CObservation&>(*object).timestamp;
    };
    return stamp(left) < stamp(right);
  });
  const Experiment experiment;
  const LampResult end = experiment.run(
      {experiment.file("one.ini", iniFor3d()), experiment.rawlog("team.rawlog", both)});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_EQ(experiment.result().trajectory("A").size(), a.truth.size());
  EXPECT_EQ(experiment.result().trajectory("B").size(), b.truth.size());
}

}  // namespace
}  // namespace lamp::test
