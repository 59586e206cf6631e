// lamp-sim through the real program, and lamp-slam on what it makes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <set>
#include <thread>

#include "Experiment.h"
#include "Measures.h"
#include "lamp/core/Trajectory.h"

namespace lamp::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kFailed = 1, kWrongUse = 2;
using Words = std::vector<std::string>;

/** Runs lamp-sim in a folder of the test's own. */
class Simulator : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return experiment_.path(name); }

  LampResult simulate(Words words, const std::string& out) const {
    words.insert(words.end(), {"--out", path(out)});
    return runSimulator(words);
  }

  /** The demo with robots that drive `metres` each, one soon after the other. */
  LampResult demo(int metres, const std::string& out, const Words& more = {},
                  const std::string& seed = "5") const {
    const std::string length = ".length_m=" + std::to_string(metres);
    Words words = {"demo", "--seed", seed};
    for (const std::string& setting :
         {std::string("world.start_interval_s=5"), std::string("world.truth_spacing_m=0.3"),
          std::string("world.loop_pairs=40"), "robot.alpha" + length, "robot.bravo" + length})
      words.insert(words.end(), {"--set", setting});
    words.insert(words.end(), more.begin(), more.end());
    return simulate(words, out);
  }

  const Experiment experiment_;
};

/** All objects of a rawlog, by MRPT's own reader. */
std::vector<mrpt::obs::CObservation::Ptr> readRawlog(const std::string& path) {
  mrpt::io::CFileGZInputStream file(path);
  auto archive = mrpt::serialization::archiveFrom(file);
  std::vector<mrpt::obs::CObservation::Ptr> all;
  while (!file.checkEOF()) {
    mrpt::serialization::CSerializable::Ptr object;
    try {
      archive >> object;
    } catch (const mrpt::serialization::CExceptionEOF&) {
      break;
    }
    if (auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object))
      all.push_back(observation);
  }
  return all;
}

std::map<std::string, int> countByLabel(
    const std::vector<mrpt::obs::CObservation::Ptr>& observations) {
  std::map<std::string, int> counts;
  for (const auto& observation : observations) ++counts[observation->sensorLabel];
  return counts;
}

double stampOf(const mrpt::obs::CObservation& observation) {
  return mrpt::Clock::toDouble(observation.timestamp);
}

TEST_F(Simulator, LeavesRecordingsTruthAndAnExperiment) {
  const LampResult end = demo(12, "world");
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.out, AllOf(HasSubstr("alpha: "), HasSubstr("lamp-slam " + path("world"))));
  Words names;
  for (const auto& [name, content] : FinishedRun(path("world")).files()) {
    names.push_back(name);
    EXPECT_FALSE(content.empty()) << name;
  }
  EXPECT_THAT(names, testing::UnorderedElementsAre(
                         "alpha.rawlog", "alpha.arrivals.csv", "bravo.rawlog", "bravo.arrivals.csv",
                         "lamp.ini", "sim.ini", "truth/alpha.tum", "truth/bravo.tum",
                         "truth/map.ply", "truth/world.json", "truth/loop_pairs.csv"));
}

TEST_F(Simulator, KeyedRecordingsHoldOneScanAndOdometryAtEachKeyNode) {
  ASSERT_EQ(demo(20, "world").exit_code, 0);
  const auto observations = readRawlog(path("world/alpha.rawlog"));
  auto counts = countByLabel(observations);
  const auto arrivals = CsvTable::fromFile(path("world/alpha.arrivals.csv"));
  const auto key_nodes = static_cast<int>(arrivals.rows.size());
  EXPECT_GE(key_nodes, 8);
  for (const char* label : {"alpha/top", "alpha/odom", "alpha/imu"})
    EXPECT_EQ(counts[label], key_nodes) << label;
  for (size_t i = 1; i < observations.size(); ++i)
    EXPECT_LE(stampOf(*observations[i - 1]), stampOf(*observations[i]));
}

TEST_F(Simulator, RawRecordingsHoldAllSensorsAtFullRate) {
  const LampResult end = demo(9, "world", {"--raw", "--set", "robot.bravo.lidars=hovermap"});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  const auto observations = readRawlog(path("world/alpha.rawlog"));
  auto counts = countByLabel(observations);
  const auto scans = static_cast<int>(readTum(path("world/truth/alpha.tum")).size());
  EXPECT_GE(scans, 60);
  EXPECT_EQ(counts["alpha/top"], scans);
  EXPECT_GE(counts["alpha/odom"], scans);
  EXPECT_LE(counts["alpha/odom"], scans + 2) << "the last sweep is covered, too";
  EXPECT_NEAR(counts["alpha/imu"], 10 * scans, 15);
  int clouds = 0;
  for (const auto& observation : observations)
    if (auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservationVelodyneScan>(observation)) {
      scan->generatePointCloud();
      EXPECT_GT(scan->point_cloud.size(), 5000u);
      ++clouds;
    }
  EXPECT_EQ(clouds, scans);
  for (size_t i = 1; i < observations.size(); ++i)
    EXPECT_LE(stampOf(*observations[i - 1]), stampOf(*observations[i]) + 0.11);
  EXPECT_GT(countByLabel(readRawlog(path("world/bravo.rawlog")))["bravo/hovermap"], 10 * scans)
      << "a rotating mount comes as short packets";
}

TEST_F(Simulator, TwoThreadsGiveTheSameBytes) {
  for (const std::string mode : {"--keyed", "--raw"}) {
    const Words hovermap = {"--set", "robot.bravo.lidars=top, hovermap"};
    for (const std::string threads : {"1", "2"}) {
      Words words = {mode, "--threads", threads};
      words.insert(words.end(), hovermap.begin(), hovermap.end());
      const LampResult end = demo(mode == "--raw" ? 5 : 15, mode + threads, words);
      ASSERT_EQ(end.exit_code, 0) << end.err;
    }
    const FinishedRun one(path(mode + "1"));
    EXPECT_GE(one.files().size(), 11u);
    expectSameFiles(one, FinishedRun(path(mode + "2")));
  }
}

TEST_F(Simulator, ItsConfigGivesTheSameBytes) {
  ASSERT_EQ(demo(10, "one").exit_code, 0);
  const LampResult end =
      simulate({"demo", "--seed", "5", "--config", path("one/sim.ini")}, "again");
  ASSERT_EQ(end.exit_code, 0) << end.err;
  expectSameFiles(FinishedRun(path("one")), FinishedRun(path("again")));
}

TEST_F(Simulator, AnotherSeedGivesAnotherWorld) {
  ASSERT_EQ(demo(8, "one").exit_code, 0);
  ASSERT_EQ(demo(8, "other", {}, "6").exit_code, 0);
  const auto one = FinishedRun(path("one")).files(), other = FinishedRun(path("other")).files();
  for (const char* name : {"alpha.rawlog", "truth/alpha.tum", "truth/map.ply"})
    EXPECT_FALSE(one.at(name) == other.at(name)) << name;
}

/** Mean distance of a trajectory from the truth, as they are: both in the world's frame. */
double meanError(const std::vector<StampedPose>& estimate, const std::vector<StampedPose>& truth) {
  const TrajectoryInterpolator at(truth);
  double sum = 0;
  for (const StampedPose& pose : estimate)
    sum += (pose.pose.translation() - at.at(pose.stamp).translation()).norm();
  return sum / static_cast<double>(estimate.size());
}

TEST_F(Simulator, LampSlamMapsWhatItMakes) {
  ASSERT_EQ(demo(60, "world").exit_code, 0);
  const LampResult end =
      experiment_.run({path("world/lamp.ini"), "--set", "pipeline.exporters="}, "run");
  ASSERT_EQ(end.exit_code, 0) << end.err;
  const FinishedRun run = experiment_.result("run");
  EXPECT_EQ(run.summary()["components"].size(), 1u);
  EXPECT_GE(run.summary()["loops"]["inliers"], 5);
  for (const std::string robot : {"alpha", "bravo"}) {
    const auto truth = readTum(path("world/truth/" + robot + ".tum"));
    EXPECT_GE(run.trajectory(robot).size(), 25u);
    EXPECT_LT(meanError(run.trajectory(robot), truth), 0.3) << robot;
  }
}

TEST_F(Simulator, AnUnknownWorldIsAFaultThatListsTheKnown) {
  const LampResult end = simulate({"tunel"}, "world");
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, HasSubstr("'tunel'; known: tunnel, urban, finals, ku, demo"));
  EXPECT_FALSE(FinishedRun(path("world")).has(""));
}

TEST_F(Simulator, FaultsOfTheConfigurationAreListedAtOnce) {
  const LampResult end =
      simulate({"demo", "--set", "world.distnce_scale=1", "--set", "world.robots=17", "--set",
                "robot.charlie.length_m=3", "--set", "novalue"},
               "world");
  EXPECT_EQ(end.exit_code, kWrongUse);
  EXPECT_THAT(end.err, AllOf(HasSubstr("[world] has no key 'distnce_scale' (did you mean "
                                       "'distance_scale'?)"),
                             HasSubstr("[world] robots = 17"), HasSubstr("novalue")));
  EXPECT_FALSE(FinishedRun(path("world")).has(""));
}

TEST_F(Simulator, AFolderThatHoldsSomethingIsLeftAlone) {
  experiment_.file("world/precious", "mine");
  const LampResult end = simulate({"demo"}, "world");
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, HasSubstr(path("world")));
  EXPECT_EQ(FinishedRun(path("world")).files().size(), 1u);
}

TEST_F(Simulator, WrongUse) {
  const std::vector<std::pair<Words, std::string>> cases = {
      {{"demo", "--raw", "--keyed", "--out", path("x")}, "--raw"},
      {{"demo", "--threads", "0", "--out", path("x")}, "--threads"},
      {{"demo", "--seed", "one", "--out", path("x")}, "--seed"},
      {{"demo", "--sed", "1", "--out", path("x")}, "--sed"},
      {{"demo"}, "--out DIR"},
      {{}, "world"}};
  for (const auto& [words, word] : cases) {
    const LampResult end = runSimulator(words);
    EXPECT_EQ(end.exit_code, kWrongUse) << word;
    EXPECT_THAT(end.err, HasSubstr(word));
    EXPECT_THAT(end.out, IsEmpty());
  }
  EXPECT_FALSE(FinishedRun(path("x")).has(""));
}

TEST_F(Simulator, AMissingConfigIsNamed) {
  const LampResult end = simulate({"demo", "--config", path("none.ini")}, "world");
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, HasSubstr(path("none.ini")));
}

TEST_F(Simulator, DumpIsAFixedPoint) {
  const LampResult first = runSimulator({"finals", "--dump-config", "--set", "world.robots=6"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("robots = 6\n"));
  const LampResult second = runSimulator(
      {"finals", "--dump-config", "--config", experiment_.file("dump.ini", first.out)});
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(second.out, first.out);
}

TEST_F(Simulator, HelpNamesWorldsAndOptions) {
  const LampResult end = runSimulator({"--help"});
  EXPECT_EQ(end.exit_code, 0);
  for (const char* word : {"tunnel: ", "urban: ", "finals: ", "ku: ", "demo: ", "--seed", "--out",
                           "--set", "--raw", "--keyed", "--threads", "--dump-config"})
    EXPECT_THAT(end.out, HasSubstr(word));
}

/** Names of the files in a folder, empty if there is no such folder. */
std::set<std::string> filesIn(const std::string& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    names.insert(entry.path().filename());
  return names;
}

TEST_F(Simulator, ASignalEndsItAndLeavesNoHalfFile) {
  const auto has_half_file = [&] {
    const auto names = filesIn(path("sim"));
    return std::any_of(names.begin(), names.end(), [](const std::string& name) {
      return name.find(".tmp") != std::string::npos;
    });
  };
  LampProcess process(LAMP_SIM, {"demo", "--raw", "--out", path("sim")});
  while (process.isRunning() && !has_half_file())
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  process.signal(SIGTERM);
  const LampResult end = process.wait();
  EXPECT_EQ(end.signal, SIGTERM) << end.exit_code;
  EXPECT_THAT(end.err, HasSubstr("ended by SIGTERM"));
  EXPECT_FALSE(has_half_file());
}

}  // namespace
}  // namespace lamp::test
