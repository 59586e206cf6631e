#include "lamp/evaluation/EvalApp.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <nlohmann/json.hpp>

#include "TestClouds.h"
#include "TestRuns.h"

namespace lamp::evaluation {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

struct Outcome {
  int exit_code = 0;
  std::string out, err;
};

Outcome eval(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "lamp-eval");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Outcome outcome;
  outcome.exit_code = evalApp(static_cast<int>(argv.size()), argv.data());
  outcome.out = testing::internal::GetCapturedStdout();
  outcome.err = testing::internal::GetCapturedStderr();
  return outcome;
}

/** A run that is 0.3 m off, with a map and the truth of both. */
class EvalApp : public testing::Test {
 protected:
  EvalApp() : run_(freshFolder()) {
    run_.addRobot("a", moved(windingPath(300), pose(0, 0, 0.3)), windingPath(300));
    SurfaceSamples floor;
    addLevel(0, 4, 0, 4, 0.1f, 1, floor);
    writePly(run_.folder().mapStem(0) + ".ply", floor.points);
    std::string truth = "ply\nformat ascii 1.0\nelement vertex " +
                        std::to_string(floor.points.size()) +
                        "\nproperty float x\nproperty float y\nproperty float z\n"
                        "property float nx\nproperty float ny\nproperty float nz\nend_header\n";
    for (const auto& p : floor.points)
      truth += formatFixed(p.x(), 4) + " " + formatFixed(p.y(), 4) + " 0 0 0 1\n";
    writeTextFile(run_.truth() + "/map.ply", truth);
  }
  Json json(const std::string& folder = "evaluation") const {
    return Json::parse(readTextFile(run_.root() + "/" + folder + "/evaluation.json"));
  }

  TestRun run_;
};

TEST_F(EvalApp, WritesTablesAndTheErrorMap) {
  const Outcome end = eval({run_.root(), "--truth", run_.truth(), "--no-pictures"});
  EXPECT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("| all robots: ATE RMSE [m] | 0.300 (0.300) |"));
  EXPECT_THAT(end.out, HasSubstr("| map: accuracy mean [m] | 0.100 |"));
  EXPECT_THAT(end.out, HasSubstr("Alignment `none`"));
  EXPECT_EQ(readTextFile(run_.root() + "/evaluation/evaluation.md"), end.out);
  const Json run = json()["runs"][0];
  EXPECT_EQ(json()["alignment"], "none");
  EXPECT_EQ(run["name"], "run");
  EXPECT_NEAR(run["trajectories"]["all"]["result"]["ate_rmse_m"], 0.3, 1e-6);
  EXPECT_NEAR(run["trajectories"]["robots"]["a"]["odometry"]["ate_max_m"], 0.3, 1e-6);
  EXPECT_NEAR(run["maps"]["map"]["accuracy_p95_m"], 0.1, 1e-6);
  EXPECT_THAT(run["notes"].dump(), HasSubstr("no loops.csv"));
  EXPECT_TRUE(std::filesystem::exists(run_.root() + "/evaluation/map_error.ply"));
  EXPECT_FALSE(std::filesystem::exists(run_.root() + "/evaluation/plots"));
}

TEST_F(EvalApp, AlignmentMovesTheMapWithTheTrajectory) {
  const Outcome end = eval(
      {run_.root(), "--truth", run_.truth(), "--align", "se3", "--json", "-", "--no-pictures"});
  EXPECT_EQ(end.exit_code, 0) << end.err;
  const Json report = Json::parse(end.out);
  EXPECT_EQ(report["alignment"], "se3");
  EXPECT_NEAR(report["runs"][0]["trajectories"]["all"]["result"]["ate_rmse_m"], 0, 1e-6);
  EXPECT_NEAR(report["runs"][0]["maps"]["map"]["accuracy_mean_m"], 0.2, 1e-4) << "0.1 - 0.3";
}

TEST_F(EvalApp, Se3LeavesNoMapOfSeveralRobots) {
  run_.addRobot("b", windingPath(200), windingPath(200));
  const Outcome end =
      eval({run_.root(), "--truth", run_.truth(), "--align", "se3", "--no-pictures"});
  EXPECT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("map 1 is not scored: alignment 'se3' moves its robots apart"));
  EXPECT_FALSE(json()["runs"][0].contains("maps"));
}

TEST_F(EvalApp, DrawsPicturesWithTheirScripts) {
  const Outcome end = eval({run_.root(), "--truth", run_.truth()});
  EXPECT_EQ(end.exit_code, 0) << end.err;
  for (const char* name :
       {"trajectories_top", "trajectories_side", "error_over_distance", "map_error", "ate_boxes"}) {
    const std::string stem = run_.root() + "/evaluation/plots/" + name;
    EXPECT_TRUE(std::filesystem::exists(stem + ".gp")) << name;
    EXPECT_TRUE(std::filesystem::exists(stem + ".dat")) << name;
    if (end.err.empty()) {  // gnuplot is installed
      EXPECT_EQ(readTextFile(stem + ".png").substr(1, 3), "PNG") << name;
    }
  }
}

TEST_F(EvalApp, WithoutGnuplotAllElseIsDone) {
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const Outcome end = eval({run_.root(), "--truth", run_.truth()});
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(end.exit_code, 0);
  EXPECT_THAT(end.err, HasSubstr("install gnuplot-nox"));
  EXPECT_EQ(json()["runs"].size(), 1u);
  EXPECT_TRUE(std::filesystem::exists(run_.root() + "/evaluation/plots/ate_boxes.gp"));
}

TEST_F(EvalApp, SeveralRunsAreColumnsOfOneTable) {
  const std::string second = run_.beside("it's 50% \"new\"");
  std::filesystem::copy(run_.root(), second, std::filesystem::copy_options::recursive);
  writeTextFile(RunFolder(second).trajectory("a"), toTum(moved(windingPath(300), pose(0, 0, 0.1))));
  const std::string out = run_.beside("comparison");
  const Outcome end = eval({run_.root(), second, "--truth", run_.truth(), "--out", out});
  EXPECT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("| | run | it's 50% \"new\" |"));
  EXPECT_THAT(end.out, HasSubstr("| all robots: ATE RMSE [m] | 0.300 (0.300) | 0.100 (0.300) |"));
  EXPECT_THAT(end.err, Not(HasSubstr("failed")));
  EXPECT_TRUE(std::filesystem::exists(out + "/1_run_map_error.ply"));
  EXPECT_TRUE(std::filesystem::exists(out + "/2_it_s_50___new__map_error.ply"));
}

TEST_F(EvalApp, RelationsNeedNoTruth) {
  const std::string relations = run_.beside("relations"), stamps = run_.beside("stamps");
  writeTextFile(relations, "1 2 0.5 0 0 0 0 0\n");
  writeTextFile(stamps, "0 1 100\n1 2 100.1\n");
  writeTextFile(run_.folder().trajectory("a"), toTum(straightPath(2, 0.6)));
  writeTextFile(run_.folder().odometryTrajectory("a"), toTum(straightPath(2, 0.7)));
  const Outcome end = eval({run_.root(), "--relations", relations, "--stamps", stamps});
  EXPECT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("| relations: translation [m] | 0.1000 ± 0.0000 |"));
  EXPECT_THAT(end.out, HasSubstr("| relations, odometry: translation [m] | 0.2000 ± 0.0000 |"));
  EXPECT_FALSE(json().contains("alignment"));
}

TEST_F(EvalApp, AnInterruptedRunSaysSo) {
  run_.writeSummary(true);
  const Outcome end = eval({run_.root(), "--truth", run_.truth(), "--no-pictures"});
  EXPECT_EQ(end.exit_code, 0);
  EXPECT_THAT(end.out, HasSubstr("the run was interrupted"));
}

TEST_F(EvalApp, WrongUse) {
  EXPECT_EQ(eval({}).exit_code, 2);
  EXPECT_EQ(eval({"--help"}).exit_code, 0);
  EXPECT_THAT(eval({"--version"}).out, HasSubstr("lamp-eval 0."));
  const std::string run = run_.root();
  EXPECT_THAT(eval({run}).err, HasSubstr("name what to compare with"));
  EXPECT_EQ(eval({run}).exit_code, 2);
  EXPECT_EQ(eval({run, "--truth", run_.truth(), "--align", "sim3"}).exit_code, 2);
  EXPECT_THAT(eval({run, "--relations", "x"}).err, HasSubstr("go together"));
  EXPECT_THAT(eval({run, run, "--truth", run_.truth()}).err, HasSubstr("--out DIR"));
  EXPECT_EQ(eval({run, "--truth", run_.truth(), "--fast"}).exit_code, 2);
}

TEST_F(EvalApp, WhatCannotBeReadOrWrittenIsAnErrorWithItsName) {
  const auto fails = [&](const std::vector<std::string>& arguments, const std::string& message) {
    const Outcome end = eval(arguments);
    EXPECT_EQ(end.exit_code, 1);
    EXPECT_THAT(end.err, HasSubstr(message));
    EXPECT_EQ(end.out, "");
  };
  const std::string run = run_.root(), truth = run_.truth();
  fails({run + "/nowhere", "--truth", truth}, "no run folder");
  fails({run, "--truth", "/nowhere"}, "--truth '/nowhere'");
  fails({run, "--truth", truth, "--no-pictures", "--out", "/proc/nowhere"}, "/proc/nowhere");
  fails({run, "--truth", truth, "--no-pictures", "--json", "/nowhere/e.json"}, "/nowhere/e.json");
  writeTextFile(truth + "/map.ply", "ply\nformat ascii 1.0\n");
  fails({run, "--truth", truth}, "map.ply:2: the file ends within its header");
  writeTextFile(run_.folder().trajectory("a"), "");
  std::filesystem::remove(truth + "/map.ply");
  fails({run, "--truth", truth}, "a.tum: holds no pose");
}

}  // namespace
}  // namespace lamp::evaluation
