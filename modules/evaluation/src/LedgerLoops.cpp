#include "lamp/evaluation/LedgerLoops.h"

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "G2oEdges.h"
#include "lamp/core/Csv.h"

namespace lamp::evaluation {

namespace {

using LedgerNodes = std::map<std::string, LedgerNode>;  ///< by `robot:index`

/** Numbers and words of one row of a table, by column. */
class Row {
 public:
  Row(const CsvTable& table, size_t row, const std::string& path)
      : table_(table), row_(row), path_(path) {}

  const std::string& text(const char* column) const {
    return table_.rows[row_][table_.column(column)];
  }
  double number(const char* column) const {
    double value = 0;
    if (!parseDouble(text(column), value) || !std::isfinite(value))
      fail(std::string("'") + text(column) + "' is no " + column);
    return value;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(path_ + ", row " + std::to_string(row_ + 1) + ": " + what);
  }

 private:
  const CsvTable& table_;
  const size_t row_;
  const std::string& path_;
};

const LedgerNode& nodeOf(const Row& row, const char* column, const LedgerNodes& nodes) {
  const auto found = nodes.find(row.text(column));
  if (found == nodes.end()) row.fail("key node '" + row.text(column) + "' is not in graph_ids.csv");
  return found->second;
}

LedgerLoop readLoop(const Row& row, const LedgerNodes& nodes) {
  LedgerLoop loop;
  loop.from = nodeOf(row, "from", nodes);
  loop.to = nodeOf(row, "to", nodes);
  loop.from_T_to.translation() << row.number("x"), row.number("y"), row.number("z");
  const Eigen::Quaterniond q(row.number("qw"), row.number("qx"), row.number("qy"),
                             row.number("qz"));
  if (!(q.norm() > 0.5)) row.fail("qx qy qz qw is not a rotation");
  loop.from_T_to.linear() = q.normalized().toRotationMatrix();
  loop.verified = row.text("stage") == "verified";
  loop.kept = row.text("verdict") == "inlier";
  // A pose that was never estimated stays the identity; a registration does not end there.
  loop.has_result = loop.verified || !loop.from_T_to.isApprox(Pose3::Identity(), 1e-9);
  return loop;
}

/** Of the edges between the two key nodes the one with the loop's pose; there may be an odometry
 * edge beside it. */
std::optional<Matrix6d> informationOf(const LedgerLoop& loop, const G2oEdges& edges) {
  constexpr double kSamePose = 1e-4;  // the ledger has six decimals
  const auto found = edges.find({loop.from.graph_id, loop.to.graph_id});
  if (found == edges.end()) return std::nullopt;
  for (const G2oEdge& edge : found->second)
    if ((edge.from_T_to.matrix() - loop.from_T_to.matrix()).cwiseAbs().maxCoeff() < kSamePose)
      return edge.information;
  return std::nullopt;
}

LedgerNodes byName(const std::vector<LedgerNode>& nodes) {
  LedgerNodes result;
  for (const LedgerNode& node : nodes) result[node.robot + ":" + std::to_string(node.index)] = node;
  return result;
}

}  // namespace

std::vector<LedgerNode> readKeyNodes(const std::string& path) {
  const CsvTable table = CsvTable::fromFile(path);
  std::vector<LedgerNode> nodes;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const Row row(table, i, path);
    nodes.push_back({row.text("robot"), static_cast<uint32_t>(row.number("index")),
                     static_cast<uint32_t>(row.number("id")), row.number("stamp")});
  }
  return nodes;
}

std::vector<LedgerLoop> readLedger(const RunFolder& run) {
  const std::string path = run.loops();
  const CsvTable table = CsvTable::fromFile(path);
  const LedgerNodes nodes = byName(readKeyNodes(run.graphIds()));
  const G2oEdges edges = readG2oEdges(run.graphG2o());
  std::map<std::string, std::pair<double, LedgerLoop>> last_attempts;  // by loop_id
  std::vector<std::string> order;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const Row row(table, i, path);
    const std::string& id = row.text("loop_id");
    const double attempt = row.number("attempt");
    const auto [found, is_new] = last_attempts.try_emplace(id);
    if (is_new) order.push_back(id);
    if (is_new || attempt > found->second.first) found->second = {attempt, readLoop(row, nodes)};
  }
  std::vector<LedgerLoop> loops;
  for (const std::string& id : order) {
    loops.push_back(last_attempts.at(id).second);
    if (loops.back().verified) loops.back().information = informationOf(loops.back(), edges);
  }
  return loops;
}

}  // namespace lamp::evaluation
