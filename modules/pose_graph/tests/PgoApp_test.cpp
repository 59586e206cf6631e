#include "lamp/pose_graph/PgoApp.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "TemporaryFolder.h"
#include "TestGraphs.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"
#include "lamp/pose_graph/G2oFile.h"

namespace lamp {
namespace {

using testing::HasSubstr;

class PgoApp : public testing::Test {
 protected:
  PgoApp() {
    WorldOptions options;
    options.robots = 1;
    options.loops = 100;
    writeTextFile(file("graph.g2o"), toG2o(makeWorld(options).graph));
  }

  std::string file(const std::string& name) const { return folder_ / name; }

  int run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "lamp-pgo");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code = pgoApp(static_cast<int>(argv.size()), argv.data());
    out = testing::internal::GetCapturedStdout();
    err = testing::internal::GetCapturedStderr();
    return code;
  }

  nlohmann::json json(const std::string& name) const {
    return nlohmann::json::parse(readTextFile(file(name)));
  }

  std::string out, err;

 private:
  test::TemporaryFolder folder_;
};

TEST_F(PgoApp, FindsTheFalseLoopsThatItAdded) {
  ASSERT_EQ(run({file("graph.g2o"), "--out", file("out.g2o"), "--add-outliers", "0.5", "--seed",
                 "3", "--json", file("report.json")}),
            0)
      << err;
  const nlohmann::json report = json("report.json");
  EXPECT_EQ(report["outliers"]["true_loops"], 100);
  EXPECT_EQ(report["outliers"]["false_loops"], 100);
  EXPECT_GE(report["outliers"]["precision"], 0.99);
  EXPECT_GE(report["outliers"]["recall"], 0.97);
  EXPECT_LT(report["cost_after"], report["cost_before"]);
  EXPECT_EQ(report["edge_rows"].size(), report["edges"]);
  const nlohmann::json last = report["edge_rows"].back();
  EXPECT_EQ(last["verdict"], "outlier");
  EXPECT_GT(last["chi2"], 10.0);
  EXPECT_THAT(out, HasSubstr("precision"));
  EXPECT_GE(readG2oFile(file("out.g2o")).graph.edges().size(), 89u + 97u);
}

TEST_F(PgoApp, TheSameSeedGivesTheSameBytes) {
  const std::vector<std::string> arguments = {file("graph.g2o"), "--out",  file("a.g2o"),
                                              "--add-outliers",  "0.3",    "--json",
                                              file("a.json"),    "--seed", "5"};
  ASSERT_EQ(run(arguments), 0);
  const std::string graph = readTextFile(file("a.g2o")), report = readTextFile(file("a.json"));
  ASSERT_EQ(run(arguments), 0);
  EXPECT_EQ(readTextFile(file("a.g2o")), graph);
  EXPECT_EQ(readTextFile(file("a.json")), report);
}

TEST_F(PgoApp, AnIniOfLampSlamChoosesTheBackEnd) {
  writeTextFile(file("plain.ini"),
                "[pipeline]\ncandidates = FixedRadius\noutlier_rejection =\noptimizer = Lm\n"
                "[lamp::Lm]\nstart = chordal\n[base_station]\nmax_attempts = 3\n");
  ASSERT_EQ(run({file("graph.g2o"), "--out", file("out.g2o"), "--config", file("plain.ini"),
                 "--json", "-"}),
            0)
      << err;
  const nlohmann::json report = nlohmann::json::parse(out);
  EXPECT_EQ(report["inliers"], 100);
  EXPECT_EQ(report["rounds"], 1);
}

TEST_F(PgoApp, CovariancesGrowFromTheFirstNode) {
  ASSERT_EQ(run({file("graph.g2o"), "--out", file("out.g2o"), "--covariances", file("c.csv")}), 0)
      << err;
  const CsvTable table = CsvTable::fromFile(file("c.csv"));
  ASSERT_EQ(table.rows.size(), 90u);
  EXPECT_EQ(table.columns.size(), 1u + 21u);
  const auto variance = [&](size_t row, const char* column) {
    return std::stod(table.rows[row][table.column(column)]);
  };
  EXPECT_EQ(variance(0, "x_x"), 0);
  EXPECT_GT(variance(1, "x_x"), 0);
  EXPECT_GT(variance(10, "x_x"), variance(1, "x_x"));
  EXPECT_LT(variance(10, "x_x"), 1.0);
}

TEST_F(PgoApp, WrongUseAndWrongFilesAreTold) {
  EXPECT_EQ(run({}), 2);
  EXPECT_EQ(run({file("graph.g2o")}), 2);
  EXPECT_EQ(run({file("graph.g2o"), "--out", file("o"), "--add-outliers", "1.5"}), 2);
  writeTextFile(file("bad.ini"), "[pipeline]\noptimizer = Gncc\n");
  EXPECT_EQ(run({file("graph.g2o"), "--out", file("o"), "--config", file("bad.ini")}), 2);
  EXPECT_THAT(err, HasSubstr("'Gnc'"));
  writeTextFile(file("bad.g2o"), "EDGE_SE2 1 1 0 0 0 1 0 0 1 0 1\n");
  EXPECT_EQ(run({file("bad.g2o"), "--out", file("o")}), 1);
  EXPECT_THAT(err, HasSubstr("bad.g2o:1"));
  EXPECT_EQ(run({"--version"}), 0);
  EXPECT_THAT(out, HasSubstr("lamp-pgo "));
}

}  // namespace
}  // namespace lamp
