#include "lamp/pose_graph/PgoApp.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "TemporaryFolder.h"
#include "TestGraphs.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"
#include "lamp/core/G2oFile.h"

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

/** The same file with gaps in the ids. */
G2oGraph withGaps(G2oGraph g2o) {
  for (uint64_t& id : g2o.ids) id = 7 + id + 3 * (id / 2);
  return g2o;
}

std::vector<Pose3> posesIn(const std::string& path) {
  const G2oGraph g2o = readG2oFile(path);
  std::vector<Pose3> poses;
  for (const Node& node : g2o.graph.nodes()) poses.push_back(node.world_T_base);
  return poses;
}

TEST_F(PgoApp, GapsInTheIdsChangeNothing) {
  std::vector<std::string> graphs = {file("graph.g2o")};
  for (const char* name : {"CSAIL", "kitti_00"})
    if (!dataFolder().empty()) graphs.push_back(dataFolder() + "/pose_graphs/" + name + ".g2o");
  for (const std::string& graph : graphs) {
    SCOPED_TRACE(graph);
    const G2oGraph g2o = readG2oFile(graph);
    writeTextFile(file("plain.g2o"), toG2o(g2o));
    writeTextFile(file("gaps.g2o"), toG2o(withGaps(g2o)));
    for (const std::string name : {"plain", "gaps"})
      ASSERT_EQ(run({file(name + ".g2o"), "--out", file(name + "_out.g2o"), "--json",
                     file(name + ".json")}),
                0)
          << err;
    const auto plain = posesIn(file("plain_out.g2o")), gaps = posesIn(file("gaps_out.g2o"));
    ASSERT_EQ(gaps.size(), plain.size());
    for (size_t i = 0; i < gaps.size(); ++i)
      ASSERT_EQ(gaps[i].matrix(), plain[i].matrix()) << "node " << i;
    EXPECT_GT(json("gaps.json")["inliers"], 99);
    EXPECT_EQ(json("gaps.json")["inliers"], json("plain.json")["inliers"]);
    EXPECT_EQ(json("gaps.json")["odometry"]["rule"], "ids");
  }
}

TEST_F(PgoApp, SaysWhatItTookForOdometry) {
  ASSERT_EQ(run({file("graph.g2o"), "--out", file("out.g2o")}), 0) << err;
  EXPECT_THAT(out, HasSubstr("odometry: 89 edges between successive ids, in 1 chain(s)"));
  writeTextFile(file("odometry.txt"), "0 1\n1 2\n");
  writeTextFile(file("lm.ini"), "[pipeline]\noutlier_rejection =\noptimizer = Lm\n");
  ASSERT_EQ(run({file("graph.g2o"), "--out", file("out.g2o"), "--json", file("r.json"),
                 "--odometry-edges", file("odometry.txt"), "--config", file("lm.ini")}),
            0)
      << err;
  EXPECT_EQ(json("r.json")["odometry"],
            (nlohmann::json{{"rule", "listed"}, {"edges", 2}, {"chains", 88}}));
  EXPECT_EQ(run({file("graph.g2o"), "--out", file("out.g2o"), "--odometry-edges", "idds"}), 2);
  EXPECT_THAT(err, HasSubstr("'idds'"));
}

TEST_F(PgoApp, AResultThatKeepsHardlyALoopIsNoSuccess) {
  G2oGraph g2o = readG2oFile(file("graph.g2o"));
  for (Edge& edge : g2o.graph.edges())
    if (edge.isLoopClosure())
      edge.from_T_to.translation() += Eigen::Vector3d(3 * edge.to.index, 9, 1);
  writeTextFile(file("false.g2o"), toG2o(g2o));
  EXPECT_EQ(run({file("false.g2o"), "--out", file("out.g2o"), "--json", file("r.json")}), 1);
  EXPECT_THAT(err, HasSubstr("less than a tenth of the loop closures"));
  EXPECT_FALSE(json("r.json")["success"]);
  // Those that lamp-pgo adds itself do not count.
  ASSERT_EQ(run({file("graph.g2o"), "--out", file("out.g2o"), "--json", file("r.json"),
                 "--add-outliers", "0.95"}),
            0)
      << err;
  EXPECT_TRUE(json("r.json")["success"]);
}

TEST_F(PgoApp, FixedNodesAndPriorsComeOutAsTheyWentIn) {
  const std::string graph = readTextFile(file("graph.g2o"));
  writeTextFile(file("fixed.g2o"), graph + "FIX 40\nFIX 80\n");
  ASSERT_EQ(run({file("fixed.g2o"), "--out", file("out.g2o")}), 0) << err;
  const auto before = posesIn(file("fixed.g2o")), after = posesIn(file("out.g2o"));
  for (const int i : {0, 40, 80}) EXPECT_TRUE(after[i].isApprox(before[i], 1e-14)) << i;
  EXPECT_FALSE(after[60].isApprox(before[60], 1e-6));
  EXPECT_THAT(readTextFile(file("out.g2o")), HasSubstr("FIX 0\nFIX 40\nFIX 80\n"));

  const std::string prior =
      "EDGE_SE3_PRIOR 0 0 7 8 9 0 0 0 1 1e6 0 0 0 0 0 1e6 0 0 0 0 1e6 0 0 0 1e6 0 0 1e6 0 1e6\n";
  std::string free = graph;
  free.erase(free.find("FIX 0\n"), 6);
  writeTextFile(file("prior.g2o"), free + prior);
  ASSERT_EQ(run({file("prior.g2o"), "--out", file("out.g2o")}), 0) << err;
  EXPECT_LT((posesIn(file("out.g2o"))[0].translation() - Eigen::Vector3d(7, 8, 9)).norm(), 1e-6);
  EXPECT_THAT(readTextFile(file("out.g2o")), HasSubstr("EDGE_SE3_PRIOR 0 0 7 8 9"));
}

TEST_F(PgoApp, InformationThatMeansNothingIsNoReasonToLoseLoops) {
  const auto withInformation = [&](const Matrix6d& information) {
    G2oGraph g2o = readG2oFile(file("graph.g2o"));
    for (Edge& edge : g2o.graph.edges()) edge.information = information;
    writeTextFile(file("same.g2o"), toG2o(g2o));
    const int code = run({file("same.g2o"), "--out", file("out.g2o"), "--json", file("r.json")});
    EXPECT_EQ(code, 0) << err;
    return json("r.json");
  };
  const nlohmann::json identity = withInformation(fromG2oInformation(Matrix6d::Identity()));
  EXPECT_EQ(identity["information"], "identity");
  EXPECT_EQ(identity["inliers"], 100);
  EXPECT_THAT(out, HasSubstr("note: the information is the identity"));

  const nlohmann::json loose = withInformation(informationOf(2.0, 0.3));
  EXPECT_EQ(loose["information"], "constant");
  EXPECT_EQ(loose["inliers"], 100);
  EXPECT_THAT(out, HasSubstr("far better than it suggests"));

  const nlohmann::json plausible = withInformation(informationOf(0.05, 0.01));
  EXPECT_EQ(plausible["information"], "constant");
  EXPECT_EQ(plausible["notes"].size(), 0u);
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
