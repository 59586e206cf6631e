// Key nodes in the order in which a radio link delivers them, through the real program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "Experiment.h"
#include "Measures.h"

namespace lamp::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kFailed = 1, kWrongUse = 2;
constexpr double kLinkBreaks = 1005, kLinkIsBack = 5000;

/** One row a scan. \param breaks from this stamp on everything arrives when the link is back. */
std::string arrivalsOf(const Recording& recording, double breaks) {
  CsvTable table{{"stamp", "arrival"}, {}};
  for (const StampedPose& scan : recording.truth)
    table.rows.push_back({formatFixed(scan.stamp, 6),
                          formatFixed(scan.stamp < breaks ? scan.stamp : kLinkIsBack, 6)});
  return table.text();
}

/** Robots A, always in link, and B, which is out of it from kLinkBreaks until A has finished. */
class InArrivalOrder : public testing::Test {
 protected:
  InArrivalOrder() {
    const BoxWorld world = BoxWorld::building(7);
    a_ = record("A", {{3, 3}, {17, 3}, {17, 12}, {3, 12}}, 1, world);
    b_ = record("B", oppositeRoute(), 2, world);
    rawlogs_ = {experiment_.rawlog("A.rawlog", a_.objects),
                experiment_.rawlog("B.rawlog", b_.objects)};
    experiment_.file("A.arrivals.csv", arrivalsOf(a_, kLinkIsBack));
    experiment_.file("B.arrivals.csv", arrivalsOf(b_, kLinkBreaks));
  }

  static Recording record(const std::string& name, const std::vector<Eigen::Vector2d>& route,
                          unsigned seed, const BoxWorld& world) {
    SyntheticRobot robot;
    robot.name = name;
    robot.route = route;
    robot.seed = seed;
    return robot.record3d(world);
  }

  std::string ini() const {
    return iniFor3d("Ply",
                    startSection("A", a_.truth.front().pose) + "arrivals = A.arrivals.csv\n" +
                        startSection("B", b_.truth.front().pose) + "arrivals = B.arrivals.csv\n");
  }

  LampResult run(const std::string& name, const std::vector<std::string>& more = {},
                 const std::string& order = "arrival") const {
    std::vector<std::string> arguments = {experiment_.file("two.ini", ini()), rawlogs_[0],
                                          rawlogs_[1], "--set", "input.order=" + order};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return experiment_.run(arguments, name);
  }

  /** Robots and stamps of the key nodes, in the order in which the base station got them. */
  std::vector<std::pair<std::string, double>> sequence(const std::string& run) const {
    const CsvTable ids = CsvTable::fromFile(experiment_.result(run).folder().graphIds());
    std::vector<std::pair<std::string, double>> result;
    for (const auto& row : ids.rows)
      result.emplace_back(row[ids.column("robot")], std::stod(row[ids.column("stamp")]));
    return result;
  }

  /** Mean of the robots' errors. */
  double ate(const std::string& run) const {
    const FinishedRun result = experiment_.result(run);
    return (ateFromFirst(result.trajectory("A"), a_.truth) +
            ateFromFirst(result.trajectory("B"), b_.truth)) /
           2;
  }

  Recording a_, b_;
  Experiment experiment_;
  std::vector<std::string> rawlogs_;
};

TEST_F(InArrivalOrder, ARobotOutOfLinkComesLateAndTheMapIsAsGood) {
  ASSERT_EQ(run("recorded", {}, "recorded").exit_code, 0);
  const LampResult end = run("arrival");
  ASSERT_EQ(end.exit_code, 0) << end.err;

  auto recorded = sequence("recorded"), arrived = sequence("arrival");
  const auto late = [](const auto& node) {
    return node.first == "B" && node.second >= kLinkBreaks;
  };
  EXPECT_FALSE(std::is_partitioned(recorded.begin(), recorded.end(),
                                   [&](const auto& node) { return !late(node); }));
  const auto in_link = [](const auto& one, const auto& two) { return one.second < two.second; };
  const auto first_late = std::find_if(arrived.begin(), arrived.end(), late);
  EXPECT_GT(std::distance(first_late, arrived.end()), 10);
  EXPECT_TRUE(std::all_of(first_late, arrived.end(), late)) << "the late ones last";
  EXPECT_TRUE(std::is_sorted(first_late, arrived.end(), in_link));
  EXPECT_TRUE(std::is_sorted(arrived.begin(), first_late, in_link)) << "the others in time";
  std::sort(recorded.begin(), recorded.end());
  std::sort(arrived.begin(), arrived.end());
  EXPECT_EQ(arrived, recorded) << "the same key nodes";

  EXPECT_EQ(experiment_.result("arrival").summary()["components"].size(), 1u);
  EXPECT_GE(experiment_.result("arrival").summary()["components"][0]["inliers_between_robots"], 3);
  RecordProperty("ate_recorded_m", std::to_string(ate("recorded")));
  RecordProperty("ate_arrival_m", std::to_string(ate("arrival")));
  EXPECT_LT(ate("arrival"), 1.5 * ate("recorded") + 0.005);
  for (const auto& [name, recording] : {std::pair{"A", a_}, std::pair{"B", b_}})
    EXPECT_EQ(experiment_.result("arrival").trajectory(name).size(), recording.truth.size())
        << "the scans after the last key node came too";
}

TEST_F(InArrivalOrder, RepeatsWithAnyThreadsAndFromItsConfig) {
  ASSERT_EQ(run("one", {"--threads", "1"}).exit_code, 0);
  ASSERT_EQ(run("two", {"--threads", "2"}).exit_code, 0);
  expectSameFiles(experiment_.result("one"), experiment_.result("two"));

  EXPECT_THAT(readFile(experiment_.path("one/config.ini")),
              AllOf(HasSubstr("order = arrival\n"),
                    HasSubstr("arrivals = " + experiment_.path("B.arrivals.csv") + "\n")));
  ASSERT_EQ(experiment_.run({experiment_.path("one/config.ini")}, "again").exit_code, 0);
  expectSameFiles(experiment_.result("one"), experiment_.result("again"));
}

TEST_F(InArrivalOrder, AFileThatIsWrongIsNamedBeforeTheRunStarts) {
  experiment_.file("B.arrivals.csv", "stamp,arrival\n1000,1000\n1001,soon\n");
  LampResult end = run("run");
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, HasSubstr("B.arrivals.csv:3: arrival 'soon' is not a finite number"));

  std::filesystem::remove(experiment_.path("B.arrivals.csv"));
  end = run("run");
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, HasSubstr(experiment_.path("B.arrivals.csv")));
  EXPECT_FALSE(experiment_.result().has("")) << "a run that cannot start leaves no folder";

  EXPECT_EQ(run("run", {}, "recorded").exit_code, 0) << "it is not read in the recorded order";
}

TEST_F(InArrivalOrder, RobotsWithoutArrivalsAreNamed) {
  const std::string no_file = experiment_.file(
      "no_file.ini", iniFor3d("", "[input]\norder = arrival\n[robot.A]\n[robot.B]\n"));
  LampResult end = experiment_.run({no_file, rawlogs_[0], rawlogs_[1]});
  EXPECT_EQ(end.exit_code, kWrongUse);
  EXPECT_THAT(end.err, AllOf(HasSubstr("[robot.A] arrivals: is missing"),
                             HasSubstr("[robot.B] arrivals: is missing")));

  const std::string no_section = experiment_.file(
      "no_section.ini", iniFor3d("", "[input]\norder = arrival\n[robot.A]\narrivals = " +
                                         experiment_.path("A.arrivals.csv") + "\n"));
  end = experiment_.run({no_section, rawlogs_[0], rawlogs_[1]});
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, AllOf(HasSubstr("without a section [robot.NAME]"), HasSubstr("arrivals: B"),
                             Not(HasSubstr("arrivals: A"))));
  EXPECT_FALSE(experiment_.result().has(""));
}

}  // namespace
}  // namespace lamp::test
