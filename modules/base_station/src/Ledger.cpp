#include "lamp/base_station/Ledger.h"

#include <algorithm>
#include <cmath>

namespace lamp {

namespace {

constexpr int kDecimals = 6;

std::string number(double value) {
  return formatFixed(value, kDecimals);
}

const Score* findScore(const LedgerRow& row, const std::string& name) {
  for (const Score& score : row.outcome.scores)
    if (score.name == name) return &score;
  return nullptr;
}

std::string scoreCell(const LedgerRow& row, const std::string& name) {
  const Score* score = findScore(row, name);
  return score ? number(score->value) : "";
}

}  // namespace

void Ledger::add(LedgerRow row) {
  auto& of_pair = by_pair_[{row.candidate.from, row.candidate.to}];
  row.loop_id = of_pair.empty() ? by_pair_.size() - 1 : rows_[of_pair.front()].loop_id;
  row.attempt = static_cast<int>(of_pair.size()) + 1;
  of_pair.push_back(rows_.size());
  if (row.edge) by_edge_[*row.edge] = rows_.size();
  rows_.push_back(std::move(row));
}

void Ledger::addVerdictChange(EdgeIndex edge, size_t round, Verdict before, const Edge& after) {
  if (!by_edge_.count(edge)) return;
  changes_.push_back(
      {round, rows_[by_edge_.at(edge)].loop_id, before, after.verdict, after.weight, after.chi2});
}

std::vector<const LedgerRow*> Ledger::attempts(KeyNodeId from, KeyNodeId to) const {
  std::vector<const LedgerRow*> result;
  if (const auto found = by_pair_.find({from, to}); found != by_pair_.end())
    for (const size_t i : found->second) result.push_back(&rows_[i]);
  return result;
}

const LedgerRow* Ledger::accepted(size_t loop_id) const {
  const LedgerRow* result = nullptr;
  for (const LedgerRow& row : rows_)
    if (row.loop_id == loop_id && row.edge) result = &row;
  return result;
}

CsvTable Ledger::loops(const PoseGraph& graph, const RobotTable& robots) const {
  CsvTable table;
  table.columns = {"loop_id",   "attempt", "round",      "from",         "to",
                   "generator", "why",     "priority",   "rank",         "stage",
                   "reason",    "overlap", "residual_m", "guess_dist_m", "guess_angle_deg",
                   "x",         "y",       "z",          "qx",           "qy",
                   "qz",        "qw",      "gnc_weight", "chi2",         "verdict"};
  std::vector<std::string> further;
  for (const LedgerRow& row : rows_)
    for (const Score& score : row.outcome.scores)
      if (std::find(further.begin(), further.end(), score.name) == further.end())
        further.push_back(score.name);
  for (const std::string& name : further) {
    if (name != "overlap" && name != "residual_m") table.columns.push_back(name);
    table.columns.push_back(name + "_threshold");
  }

  for (const LedgerRow& row : rows_) {
    const LoopClosureAttempt& outcome = row.outcome;
    const Pose3& pose = outcome.result.target_T_source;
    const Pose3 deviation = row.guess.target_T_source.inverse() * pose;
    const Eigen::Quaterniond q(pose.linear());
    const Edge* edge = row.edge ? &graph.edges()[*row.edge] : nullptr;
    std::vector<std::string> cells = {std::to_string(row.loop_id),
                                      std::to_string(row.attempt),
                                      std::to_string(row.round),
                                      robots.format(row.candidate.from),
                                      robots.format(row.candidate.to),
                                      row.candidate.generator,
                                      row.candidate.why,
                                      number(row.candidate.priority),
                                      std::to_string(row.rank),
                                      outcome.stage,
                                      outcome.reason,
                                      scoreCell(row, "overlap"),
                                      scoreCell(row, "residual_m"),
                                      number(deviation.translation().norm()),
                                      number(rotationAngle(deviation) * 180.0 / M_PI)};
    for (const double value : {pose.translation().x(), pose.translation().y(),
                               pose.translation().z(), q.x(), q.y(), q.z(), q.w()})
      cells.push_back(number(value));
    cells.push_back(edge ? number(edge->weight) : "");
    cells.push_back(edge ? number(edge->chi2) : "");
    cells.push_back(edge ? toString(edge->verdict) : "refused");
    for (const std::string& name : further) {
      const Score* score = findScore(row, name);
      if (name != "overlap" && name != "residual_m") cells.push_back(scoreCell(row, name));
      cells.push_back(score && score->threshold ? number(*score->threshold) : "");
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

CsvTable Ledger::verdicts() const {
  CsvTable table{{"round", "loop_id", "before", "after", "gnc_weight", "chi2"}, {}};
  for (const VerdictChange& change : changes_)
    table.rows.push_back({std::to_string(change.round), std::to_string(change.loop_id),
                          toString(change.before), toString(change.after),
                          number(change.gnc_weight), number(change.chi2)});
  return table;
}

}  // namespace lamp
