// Same input, same bytes; and what a run leaves that is stopped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "Experiment.h"

namespace lamp::test {
namespace {

using testing::HasSubstr;

SyntheticRobot robot(const std::string& name, const std::vector<Eigen::Vector2d>& route) {
  SyntheticRobot result;
  result.name = name;
  result.route = route;
  return result;
}

/** A run of two robots with maps of all kinds, on one thread. */
class Repeatability : public testing::Test {
 protected:
  Repeatability() {
    const BoxWorld world = BoxWorld::building(7);
    const Recording a = robot("A", {{3, 3}, {17, 3}, {17, 8}}).record3d(world);
    const Recording b = robot("B", {{17, 8}, {17, 3}, {8, 3}}).record3d(world);
    const std::string starts =
        startSection("A", a.truth.front().pose) + startSection("B", b.truth.front().pose);
    arguments_ = {experiment_.file("two.ini", iniFor3d("Ply, Pcd, OctoMap, Picture", starts)),
                  experiment_.rawlog("A.rawlog", a.objects),
                  experiment_.rawlog("B.rawlog", b.objects)};
    const LampResult end = run("one", {"--threads", "1"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    const auto loops = experiment_.result("one").summary()["loops"];
    EXPECT_GE(loops["inliers"], 5) << "registration, on several threads, must matter";
  }

  LampResult run(const std::string& name, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = arguments_;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return experiment_.run(arguments, name);
  }

  Experiment experiment_;
  std::vector<std::string> arguments_;
};

TEST_F(Repeatability, TwoThreadsGiveTheSameBytes) {
  const LampResult end = run("two", {"--threads", "2"});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  expectSameFiles(experiment_.result("one"), experiment_.result("two"));
}

TEST_F(Repeatability, ConfigOfARunGivesTheSameBytes) {
  const LampResult end = experiment_.run({experiment_.path("one/config.ini")}, "again");
  ASSERT_EQ(end.exit_code, 0) << end.err;
  expectSameFiles(experiment_.result("one"), experiment_.result("again"));
}

/** An ini that keeps the program busy for long. */
std::string slowIni() {
  return iniFor3d("Ply, Pcd, OctoMap, Picture", R"(
[lamp::AdaptiveRadius]
min_index_gap = 1
min_radius_m = 20
max_per_robot = 400
)");
}

/** Waits until the program has made its folder, half a minute at most, and a little more. */
bool waitUntilBusy(LampProcess& process, const FinishedRun& run) {
  for (int i = 0; i < 1500 && process.isRunning() && !run.has(""); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::this_thread::sleep_for(std::chrono::seconds(1));
  return process.isRunning() && run.has("");
}

/** Three laps, which keep the program busy for long with slowIni(). */
Recording longRecording() {
  SyntheticRobot long_way = robot("A", ringRoute());
  for (int lap = 0; lap < 2; ++lap)
    for (const Eigen::Vector2d& point : ringRoute()) long_way.route.push_back(point);
  return long_way.record3d(BoxWorld::building(7));
}

class EndSignal : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Of, EndSignal, testing::Values(SIGINT, SIGTERM, SIGHUP),
                         [](const auto& signal) { return ::sigabbrev_np(signal.param); });

TEST_P(EndSignal, LeavesACompleteRunFolder) {
  const Experiment experiment;
  const Recording recording = longRecording();
  LampProcess process({experiment.file("slow.ini", slowIni()),
                       experiment.rawlog("A.rawlog", recording.objects), "--threads", "1", "--set",
                       "frontend.key_node_distance_m=0.3", "--out", experiment.path("run")});
  const FinishedRun run = experiment.result();
  ASSERT_TRUE(waitUntilBusy(process, run)) << process.wait().err;
  process.signal(GetParam());
  const LampResult end = process.wait();

  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.err, HasSubstr(std::string("SIG") + ::sigabbrev_np(GetParam())));
  EXPECT_THAT(end.out, HasSubstr("interrupted"));
  EXPECT_EQ(run.summary()["interrupted"], true);
  const size_t poses = run.trajectory("A").size();
  EXPECT_GT(poses, 0u);
  EXPECT_LT(poses, recording.truth.size());
  for (const char* file :
       {"config.ini", "trajectories/A.tum", "trajectories/A.keyframes.tum",
        "trajectories/A.odometry.tum", "graph.g2o", "graph.graph", "graph_ids.csv", "loops.csv",
        "verdicts.csv", "actions.csv", "keyframes/A.rawlog", "maps/map.ply", "maps/map.pcd",
        "maps/map.bt", "maps/map.ot", "maps/map.png", "summary.json", "timings.json"})
    EXPECT_TRUE(run.has(file)) << file;
  EXPECT_EQ(run.files().size(), 17u) << "and nothing temporary beside them";
}

TEST(Interrupt, TheSecondSignalEndsTheProgram) {
  const Experiment experiment;
  const Recording recording = longRecording();
  LampProcess process({experiment.file("slow.ini", slowIni()),
                       experiment.rawlog("A.rawlog", recording.objects), "--threads", "1", "--set",
                       "frontend.key_node_distance_m=0.3", "--out", experiment.path("run")});
  ASSERT_TRUE(waitUntilBusy(process, experiment.result())) << process.wait().err;
  process.signal(SIGTERM);
  process.signal(SIGHUP);
  const LampResult end = process.wait();
  EXPECT_EQ(end.signal, SIGHUP) << end.exit_code << end.err;
  for (const auto& [file, content] : experiment.result().files())
    EXPECT_THAT(file, testing::Not(HasSubstr(".tmp")));
}

TEST(Interrupt, ASecondRunIntoTheSameFolderIsRefused) {
  const Experiment experiment;
  const Recording recording = longRecording();
  const std::vector<std::string> arguments = {experiment.file("slow.ini", slowIni()),
                                              experiment.rawlog("A.rawlog", recording.objects),
                                              "--threads",
                                              "1",
                                              "--out",
                                              experiment.path("run")};
  LampProcess process(arguments);
  ASSERT_TRUE(waitUntilBusy(process, experiment.result())) << process.wait().err;
  const LampResult second = runLamp(arguments);
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_THAT(second.err, HasSubstr("is being written by another program"));
  process.signal(SIGINT);
  EXPECT_EQ(process.wait().exit_code, 0);
}

TEST(Interrupt, LeavesOutWhatHasNotArrivedYet) {
  const Experiment experiment;
  const Recording a = longRecording(),
                  b = robot("B", oppositeRoute()).record3d(BoxWorld::building(7));
  const std::string ini =
      slowIni() +
      "[robot.A]\narrivals = " + experiment.file("A.csv", "stamp,arrival\n1000,1000\n2000,2000\n") +
      "\n[robot.B]\narrivals = " + experiment.file("B.csv", "stamp,arrival\n2000,9000\n") + "\n";
  LampProcess process({experiment.file("slow.ini", ini), experiment.rawlog("A.rawlog", a.objects),
                       experiment.rawlog("B.rawlog", b.objects), "--threads", "1", "--set",
                       "frontend.key_node_distance_m=0.3", "--set", "input.order=arrival", "--out",
                       experiment.path("run")});
  ASSERT_TRUE(waitUntilBusy(process, experiment.result())) << process.wait().err;
  process.signal(SIGINT);
  const LampResult end = process.wait();
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_EQ(experiment.result().summary()["interrupted"], true);
  EXPECT_TRUE(experiment.result().has("trajectories/A.tum"));
  EXPECT_FALSE(experiment.result().has("trajectories/B.tum"));
}

}  // namespace
}  // namespace lamp::test
