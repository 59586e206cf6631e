#include "lamp/base_station/Ledger.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>

#include "TestTeam.h"
#include "lamp/core/Files.h"

namespace lamp {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::IsEmpty;

/** Text between the heading of a file in docs/run-folder.md and the next heading. */
std::string documentationOf(const std::string& file) {
  const std::string page = readTextFile(LAMP_SOURCE_DIR "/docs/run-folder.md");
  const size_t begin = page.find("\n## " + file + "\n");
  EXPECT_NE(begin, std::string::npos) << file;
  return page.substr(begin + 1, page.find("\n## ", begin + 1) - begin);
}

std::vector<std::string> backticked(const std::string& text) {
  static const std::regex kWord("`([a-z0-9_]+)`");
  std::vector<std::string> words;
  for (std::sregex_iterator it(text.begin(), text.end(), kWord), end; it != end; ++it)
    words.push_back((*it)[1]);
  return words;
}

/** Words in backticks in the first cells of a Markdown table; `<name>` is no fixed column. */
std::vector<std::string> documentedColumns(const std::string& file) {
  std::istringstream lines(documentationOf(file));
  std::vector<std::string> columns;
  std::string line;
  while (std::getline(lines, line)) {
    if (line.rfind("| `", 0) != 0) continue;
    for (const std::string& word : backticked(line.substr(0, line.find('|', 1))))
      columns.push_back(word);
  }
  return columns;
}

class LedgerTest : public testing::Test {
 protected:
  LedgerTest() {
    robots_.add("husky");
    robots_.add("spot");
    for (const RobotId robot : {kA, kB})
      for (uint32_t i = 0; i < 3; ++i) {
        Node node;
        node.id = {robot, i};
        graph_.addNode(node);
      }
  }

  static LedgerRow row(KeyNodeId from, KeyNodeId to) {
    LedgerRow row;
    row.round = 4;
    row.rank = 2;
    row.candidate = {from, to, "FixedRadius", 1.5};
    row.guess.target_T_source = planarPose(1, 2, 0);
    row.outcome.result.target_T_source = planarPose(4, 6, M_PI / 2);
    row.outcome.stage = "OverlapResidual";
    row.outcome.reason = "low overlap";
    row.outcome.scores = {{"overlap", 0.25, 0.6}, {"residual_m", 0.05, 0.1}};
    return row;
  }

  LedgerRow acceptedRow(KeyNodeId from, KeyNodeId to) {
    Edge edge;
    edge.type = EdgeType::kLoopClosure;
    edge.from = from;
    edge.to = to;
    edge.verdict = Verdict::kPending;
    LedgerRow accepted = row(from, to);
    accepted.edge = graph_.addEdge(edge);
    accepted.outcome.accepted = true;
    accepted.outcome.stage = "verified";
    accepted.outcome.reason = "";
    return accepted;
  }

  std::string cell(size_t row, const std::string& column) const {
    const CsvTable table = ledger_.loops(graph_, robots_);
    return table.rows.at(row).at(table.column(column));
  }

  RobotTable robots_;
  PoseGraph graph_;
  Ledger ledger_;
};

TEST_F(LedgerTest, HasTheDocumentedColumns) {
  const auto documented = documentedColumns("loops.csv");
  EXPECT_EQ(documented.size(), 25u);
  EXPECT_EQ(ledger_.loops(graph_, robots_).columns, documented);
  EXPECT_EQ(ledger_.verdicts().columns, (std::vector<std::string>{"round", "loop_id", "before",
                                                                  "after", "gnc_weight", "chi2"}));
  EXPECT_THAT(backticked(documentationOf("verdicts.csv")),
              testing::IsSupersetOf(ledger_.verdicts().columns));
  EXPECT_THAT(ledger_.loops(graph_, robots_).rows, IsEmpty());
}

TEST_F(LedgerTest, WritesAnAttempt) {
  ledger_.add(row({kA, 1}, {kB, 2}));
  EXPECT_EQ(cell(0, "loop_id"), "0");
  EXPECT_EQ(cell(0, "attempt"), "1");
  EXPECT_EQ(cell(0, "round"), "4");
  EXPECT_EQ(cell(0, "rank"), "2");
  EXPECT_EQ(cell(0, "from"), "husky:1");
  EXPECT_EQ(cell(0, "to"), "spot:2");
  EXPECT_EQ(cell(0, "generator"), "FixedRadius");
  EXPECT_EQ(std::stod(cell(0, "priority")), 1.5);
  EXPECT_EQ(cell(0, "stage"), "OverlapResidual");
  EXPECT_EQ(cell(0, "reason"), "low overlap");
  EXPECT_EQ(std::stod(cell(0, "overlap")), 0.25);
  EXPECT_EQ(std::stod(cell(0, "residual_m")), 0.05);
  EXPECT_NEAR(std::stod(cell(0, "guess_dist_m")), 5, 1e-6) << "from (1, 2) to (4, 6)";
  EXPECT_NEAR(std::stod(cell(0, "guess_angle_deg")), 90, 1e-5);
  EXPECT_EQ(std::stod(cell(0, "x")), 4);
  EXPECT_NEAR(std::stod(cell(0, "qz")), std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(std::stod(cell(0, "qw")), std::sqrt(0.5), 1e-6);
  EXPECT_EQ(cell(0, "gnc_weight"), "");
  EXPECT_EQ(cell(0, "chi2"), "");
  EXPECT_EQ(cell(0, "verdict"), "refused");
  EXPECT_EQ(std::stod(cell(0, "overlap_threshold")), 0.6);
}

TEST_F(LedgerTest, FurtherScoresHaveTheirColumns) {
  ledger_.add(row({kA, 0}, {kA, 2}));
  LedgerRow with_more = row({kA, 1}, {kA, 2});
  with_more.outcome.scores = {{"guess_chi2", 12.5, 33.0}, {"free_space", 0.75, {}}};
  ledger_.add(with_more);
  EXPECT_EQ(cell(0, "guess_chi2"), "");
  EXPECT_EQ(cell(0, "guess_chi2_threshold"), "");
  EXPECT_EQ(std::stod(cell(1, "guess_chi2")), 12.5);
  EXPECT_EQ(std::stod(cell(1, "guess_chi2_threshold")), 33);
  EXPECT_EQ(std::stod(cell(1, "free_space")), 0.75);
  EXPECT_EQ(cell(1, "free_space_threshold"), "");
  EXPECT_EQ(cell(1, "overlap"), "");
  for (const auto& cells : ledger_.loops(graph_, robots_).rows)
    EXPECT_EQ(cells.size(), ledger_.loops(graph_, robots_).columns.size());
}

TEST_F(LedgerTest, AttemptsAtAPairShareItsId) {
  ledger_.add(row({kA, 0}, {kA, 2}));
  ledger_.add(row({kA, 0}, {kB, 2}));
  ledger_.add(row({kA, 0}, {kA, 2}));
  ledger_.add(row({kB, 0}, {kB, 2}));
  const auto column = [&](const std::string& name) {
    std::vector<std::string> cells;
    for (size_t i = 0; i < 4; ++i) cells.push_back(cell(i, name));
    return cells;
  };
  EXPECT_THAT(column("loop_id"), ElementsAre("0", "1", "0", "2"));
  EXPECT_THAT(column("attempt"), ElementsAre("1", "1", "2", "1"));
  const auto attempts = ledger_.attempts({kA, 0}, {kA, 2});
  ASSERT_EQ(attempts.size(), 2u);
  EXPECT_EQ(attempts[0]->attempt, 1);
  EXPECT_EQ(attempts[1]->attempt, 2);
  EXPECT_THAT(ledger_.attempts({kA, 2}, {kA, 0}), IsEmpty()) << "a pair has a direction";
}

TEST_F(LedgerTest, AcceptedAttemptsShowTheLastVerdict) {
  ledger_.add(row({kA, 0}, {kB, 0}));
  ledger_.add(acceptedRow({kA, 0}, {kB, 1}));
  EXPECT_EQ(cell(1, "verdict"), "pending");
  Edge& edge = graph_.edges().front();
  edge.verdict = Verdict::kOutlier;
  edge.weight = 0.125;
  edge.chi2 = 40.5;
  ledger_.addVerdictChange(0, 7, Verdict::kPending, edge);
  EXPECT_EQ(cell(0, "verdict"), "refused");
  EXPECT_EQ(cell(1, "verdict"), "outlier");
  EXPECT_EQ(std::stod(cell(1, "gnc_weight")), 0.125);
  EXPECT_EQ(std::stod(cell(1, "chi2")), 40.5);

  edge.verdict = Verdict::kInlier;
  edge.weight = 1;
  ledger_.addVerdictChange(0, 9, Verdict::kOutlier, edge);
  const CsvTable verdicts = ledger_.verdicts();
  ASSERT_EQ(verdicts.rows.size(), 2u);
  EXPECT_EQ(verdicts.rows[0][0], "7");
  EXPECT_EQ(verdicts.rows[0][1], "1") << "the loop's id, not the edge's";
  EXPECT_EQ(verdicts.rows[0][2], "pending");
  EXPECT_EQ(verdicts.rows[0][3], "outlier");
  EXPECT_EQ(verdicts.rows[1][2], "outlier");
  EXPECT_EQ(verdicts.rows[1][3], "inlier");
}

TEST_F(LedgerTest, WhatABaseStationWritesReadsBack) {
  const Team team;
  Station station(teamIni());
  team.sendTo(station.base);
  const PoseGraph& graph = station.base.graph();
  const CsvTable loops = station.base.ledger().loops(graph, robots_);
  const CsvTable read = CsvTable::fromText(loops.text(), "loops.csv");
  EXPECT_EQ(read.rows, loops.rows);
  EXPECT_EQ(read.columns, loops.columns);
  EXPECT_TRUE(read.has("guess_chi2_threshold"));

  // The last change of each loop's verdict is the verdict that the ledger shows.
  std::map<std::string, std::string> last;
  for (const auto& change : station.base.ledger().verdicts().rows) last[change[1]] = change[3];
  size_t accepted = 0;
  for (const auto& cells : read.rows) {
    const std::string verdict = cells[read.column("verdict")];
    EXPECT_EQ(verdict == "refused", cells[read.column("stage")] != "verified");
    if (verdict == "refused") continue;
    EXPECT_EQ(last.at(cells[read.column("loop_id")]), verdict);
    ++accepted;
  }
  EXPECT_EQ(last.size(), accepted);
  EXPECT_GT(accepted, 0u);
}

}  // namespace
}  // namespace lamp
