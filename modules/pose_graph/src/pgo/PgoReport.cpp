#include "pgo/PgoReport.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>

#include "lamp/pose_graph/EdgeResiduals.h"
#include "lamp/pose_graph/MarginalCovariances.h"

namespace lamp {

namespace {

using Json = nlohmann::ordered_json;

/** Precision and recall of the kept loops; null where nothing is counted. */
Json scores(const OptimizationResult& result, size_t true_edges) {
  double kept = 0, right = 0, all = 0;
  for (const LoopVerdict& loop : result.loops) {
    const bool is_true = loop.edge < true_edges, inlier = loop.verdict == Verdict::kInlier;
    kept += inlier;
    all += is_true;
    right += is_true && inlier;
  }
  const auto share = [](double part, double whole) {
    return whole > 0 ? Json(part / whole) : Json();
  };
  return {{"true_loops", static_cast<size_t>(all)},
          {"false_loops", result.loops.size() - static_cast<size_t>(all)},
          {"precision", share(right, kept)},
          {"recall", share(right, all)}};
}

/** Whether at least a tenth of the file's loop closures was kept. */
bool isSuccess(const OptimizationResult& result, const PoseGraph& graph, size_t true_edges) {
  size_t kept = 0, all = 0;
  for (const LoopVerdict& loop : result.loops) {
    if (loop.edge >= true_edges || !graph.edges()[loop.edge].isLoopClosure()) continue;
    ++all;
    kept += loop.verdict == Verdict::kInlier;
  }
  return result.report.usable && 10 * kept >= all;
}

/** Chains are unbroken pieces of odometry; a node without odometry is a chain of its own. */
Json odometry(const G2oGraph& g2o) {
  const auto& edges = g2o.graph.edges();
  const auto count = static_cast<size_t>(std::count_if(
      edges.begin(), edges.end(), [](const Edge& e) { return e.type == EdgeType::kOdometry; }));
  return {{"rule", toString(g2o.odometry)},
          {"edges", count},
          {"chains", g2o.graph.nodes().size() - count}};
}

const char* inWords(const std::string& rule) {
  if (rule == toString(OdometryRule::kNext)) return "from each id to the next number";
  if (rule == toString(OdometryRule::kVertices)) return "between successive VERTEX lines";
  if (rule == toString(OdometryRule::kEdges)) return "that form paths, in the order of the file";
  if (rule == toString(OdometryRule::kListed)) return "as listed";
  return "between successive ids";
}

Json edgeRows(const G2oGraph& g2o, const OptimizationResult& result,
              const std::vector<double>& residuals2) {
  Json rows = Json::array();
  const std::vector<Edge>& edges = g2o.graph.edges();
  for (EdgeIndex e = 0; e < edges.size(); ++e)
    rows.push_back({{"from", g2o.name(edges[e].from)},
                    {"to", edges[e].endsAtLandmark() ? g2o.graph.landmarks()[edges[e].landmark].name
                                                     : g2o.name(edges[e].to)},
                    {"type", toString(edges[e].type)},
                    {"weight", 1.0},
                    {"verdict", toString(Verdict::kInlier)},
                    {"chi2", residuals2[e]}});
  for (const LoopVerdict& loop : result.loops) {
    rows[loop.edge]["weight"] = loop.weight;
    rows[loop.edge]["verdict"] = toString(loop.verdict);
  }
  return rows;
}

}  // namespace

Json pgoReport(const G2oGraph& g2o, const OptimizationResult& result, size_t true_edges) {
  std::vector<Pose3> before;
  for (const Node& node : g2o.graph.nodes()) before.push_back(node.world_T_base);
  const auto residuals_before = edgeResiduals2(g2o.graph, before);
  PoseGraph solved = g2o.graph;
  applyResult(result, solved);
  const auto residuals_after = edgeResiduals2(solved, result.world_T_base);
  const Json rows = edgeRows(g2o, result, residuals_after);
  double cost_before = 0, cost_after = 0;
  size_t loops = 0, inliers = 0, sightings = 0, sightings_kept = 0;
  for (EdgeIndex e = 0; e < rows.size(); ++e) {
    cost_before += 0.5 * residuals_before[e];
    cost_after += 0.5 * rows[e]["weight"].get<double>() * residuals_after[e];
  }
  for (const LoopVerdict& loop : result.loops) {
    const bool is_loop = g2o.graph.edges()[loop.edge].isLoopClosure();
    ++(is_loop ? loops : sightings);
    (is_loop ? inliers : sightings_kept) += loop.verdict == Verdict::kInlier;
  }
  Json report = {{"planar", g2o.graph.planar()},
                 {"nodes", g2o.graph.nodes().size()},
                 {"robots", g2o.letters.size()},
                 {"edges", rows.size()},
                 {"odometry", odometry(g2o)},
                 {"information", toString(g2o.information)},
                 {"notes", g2o.notes},
                 {"loops", loops},
                 {"landmarks", g2o.graph.landmarks().size()},
                 {"sightings", sightings},
                 {"sightings_kept", sightings_kept},
                 {"inliers", inliers},
                 {"skipped_lines", g2o.skipped},
                 {"usable", result.report.usable},
                 {"success", isSuccess(result, g2o.graph, true_edges)},
                 {"termination", result.report.termination},
                 {"rounds", result.report.rounds},
                 {"iterations", result.report.iterations},
                 {"odometry_scale", result.report.odometry_scale},
                 {"cost_before", cost_before},
                 {"cost_after", cost_after}};
  if (true_edges < rows.size()) report["outliers"] = scores(result, true_edges);
  report["edge_rows"] = rows;
  return report;
}

CsvTable covarianceTable(const G2oGraph& g2o) {
  constexpr std::array<const char*, 6> kAxes = {"x", "y", "z", "rx", "ry", "rz"};
  CsvTable table{{"id"}, {}};
  for (size_t i = 0; i < kAxes.size(); ++i)
    for (size_t j = i; j < kAxes.size(); ++j)
      table.columns.push_back(std::string(kAxes[i]) + "_" + kAxes[j]);
  const MarginalCovariances marginals(g2o.graph);
  for (const Node& node : g2o.graph.nodes()) {
    const Matrix6d covariance = marginals.covariance(node.id);
    std::vector<std::string> row = {std::to_string(g2o.ids[g2o.graph.place(node.id)])};
    for (int i = 0; i < 6; ++i)
      for (int j = i; j < 6; ++j) row.push_back(formatDouble(covariance(i, j)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string pgoSummary(const Json& report) {
  std::ostringstream text;
  text << std::setprecision(8) << report["nodes"] << " nodes of " << report["robots"]
       << " robot(s), " << report["edges"] << " edges\n"
       << "odometry: " << report["odometry"]["edges"] << " edges "
       << inWords(report["odometry"]["rule"]) << ", in " << report["odometry"]["chains"]
       << " chain(s)\n"
       << "loop closures: " << report["inliers"] << " of " << report["loops"] << " kept\n"
       << (report["landmarks"] > 0 ? "landmarks: " + report["landmarks"].dump() +
                                         ", sightings: " + report["sightings_kept"].dump() +
                                         " of " + report["sightings"].dump() + " kept\n"
                                   : "")
       << "cost: " << report["cost_before"].get<double>() << " before, with all edges; "
       << report["cost_after"].get<double>() << " after, weighted\n"
       << report["rounds"] << " rounds, " << report["iterations"] << " iterations; "
       << report["termination"].get<std::string>() << "\n";
  for (const std::string note : report["notes"]) text << "note: " << note << "\n";
  for (const auto& [tag, count] : report["skipped_lines"].items())
    text << "skipped: " << count << " lines " << tag << "\n";
  if (report.contains("outliers")) {
    const Json& outliers = report["outliers"];
    text << "of " << outliers["true_loops"] << " true and " << outliers["false_loops"]
         << " false loops: precision " << outliers["precision"] << ", recall " << outliers["recall"]
         << "\n";
  }
  return text.str();
}

}  // namespace lamp
