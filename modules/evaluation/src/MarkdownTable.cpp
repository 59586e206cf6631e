#include "MarkdownTable.h"

#include <algorithm>
#include <vector>

#include "lamp/core/Csv.h"

namespace lamp {

namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

/** One row of a table: where its figure stands in the JSON of a run, and how it is shown. */
struct Row {
  std::string label;
  std::string path;
  int decimals;
  double factor = 1.0;
};

const std::vector<Row> kTrajectoryRows = {
    {"ATE RMSE [m]", "ate_rmse_m", 3},
    {"ATE mean [m]", "ate_mean_m", 3},
    {"ATE max [m]", "ate_max_m", 3},
    {"rotation error mean [deg]", "rotation_mean_deg", 2},
    {"rotation error max [deg]", "rotation_max_deg", 2},
    {"drift per 10 m [%]", "drift_10m/translation_percent", 2},
    {"drift per 100 m [%]", "drift_100m/translation_percent", 2},
    {"drift per 10 m [deg/m]", "drift_10m/rotation_deg_per_m", 4},
    {"drift per 100 m [deg/m]", "drift_100m/rotation_deg_per_m", 4},
};
const std::vector<Row> kCoverageRows = {
    {"scans with a true pose", "scans_joined", 0},
    {"share of scans [%]", "scans_joined_share", 1, 100.0},
    {"share of the truth [%]", "truth_covered_share", 1, 100.0},
};
const std::vector<Row> kRelationRows = {
    {"translation mean [m]", "translation_mean_m", 4},
    {"translation std [m]", "translation_std_m", 4},
    {"rotation mean [deg]", "rotation_mean_deg", 3},
    {"rotation std [deg]", "rotation_std_deg", 3},
    {"relations", "relations", 0},
};

std::string cell(const Json& run, const std::string& path, const Row& row) {
  const Pointer pointer(path + "/" + row.path);
  if (!run.contains(pointer)) return "–";
  const Json& value = run.at(pointer);
  if (value.is_null()) return "n/a";
  return value.is_number() ? formatFixed(row.factor * value.get<double>(), row.decimals)
                           : value.get<std::string>();
}

/** Rows of figures below one path, if any run has them. */
void appendRows(const Json& runs, const std::string& title, const std::string& path,
                const std::vector<Row>& rows, std::string& text) {
  for (const Row& row : rows) {
    std::string line = "| " + title + ": " + row.label + " |";
    bool any = false;
    for (const Json& run : runs) {
      const std::string value = cell(run, path, row);
      any = any || value != "–";
      line += " " + value + " |";
    }
    if (any) text += line + "\n";
  }
}

void appendTrajectory(const Json& runs, const std::string& title, const std::string& path,
                      std::string& text) {
  appendRows(runs, title, path + "/result", kTrajectoryRows, text);
  appendRows(runs, title + " odometry", path + "/odometry", kTrajectoryRows, text);
  appendRows(runs, title, path + "/result", kCoverageRows, text);
}

/** Keys of an object in any of the runs, in the order in which they come. */
std::vector<std::string> keysOf(const Json& runs, const std::string& path) {
  std::vector<std::string> keys;
  for (const Json& run : runs) {
    if (!run.contains(Pointer(path))) continue;
    for (const auto& item : run.at(Pointer(path)).items())
      if (std::find(keys.begin(), keys.end(), item.key()) == keys.end()) keys.push_back(item.key());
  }
  return keys;
}

std::string tableRows(const Json& runs) {
  std::string text;
  appendTrajectory(runs, "all robots", "/trajectories/all", text);
  for (const std::string& robot : keysOf(runs, "/trajectories/robots"))
    appendTrajectory(runs, robot, "/trajectories/robots/" + robot, text);
  for (const auto& [key, title] :
       {std::pair("all", "relations"), std::pair("below_5_s", "relations below 5 s"),
        std::pair("from_5_s", "relations from 5 s")}) {
    const std::string of = std::string("/") + key;
    appendRows(runs, title, "/relations/result" + of, kRelationRows, text);
    appendRows(runs, std::string(title) + " odometry", "/relations/odometry" + of, kRelationRows,
               text);
  }
  return text;
}

std::string escaped(std::string text) {
  for (size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, "\\");
  return text;
}

}  // namespace

std::string markdownReport(const Json& report) {
  const Json& runs = report.at("runs");
  std::string text;
  if (report.contains("alignment"))
    text += "Alignment `" + report.at("alignment").get<std::string>() +
            "`: " + report.at("alignment_meaning").get<std::string>() + ".\n\n";
  std::string head = "| |", line = "|---|";
  for (const Json& run : runs) {
    head += " " + escaped(run.at("name")) + " |";
    line += "---:|";
  }
  text += head + "\n" + line + "\n" + tableRows(runs);
  for (const Json& run : runs)
    for (const Json& note : run.at("notes"))
      text += "\n- " + run.at("name").get<std::string>() + ": " + note.get<std::string>();
  return text + "\n";
}

}  // namespace lamp
