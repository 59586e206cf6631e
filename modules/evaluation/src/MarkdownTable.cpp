#include "MarkdownTable.h"

#include <algorithm>
#include <vector>

#include "ReportRows.h"
#include "lamp/core/Csv.h"

namespace lamp::evaluation {

namespace {

using Json = nlohmann::ordered_json;
using Pointer = Json::json_pointer;

const char* const kMissing = "–";

/** The figure that `{path:decimals}` names. */
std::string figure(const Json& run, const std::string& path, char kind, int decimals) {
  if (!run.contains(Pointer(path))) return kMissing;
  const Json& value = run.at(Pointer(path));
  if (!value.is_number()) return "n/a";
  return formatFixed(value.get<double>() * (kind == '%' ? 100.0 : 1.0), decimals);
}

/** \param[out] any whether the run has one of the figures. */
std::string cell(const Json& run, const std::string& path, const std::string& pattern, bool& any) {
  std::string text;
  for (size_t at = 0; at < pattern.size(); ++at) {
    if (pattern[at] != '{') {
      text += pattern[at];
      continue;
    }
    const size_t end = pattern.find('}', at), kind = pattern.find_last_of(":%", end);
    const std::string value =
        figure(run, path + "/" + pattern.substr(at + 1, kind - at - 1), pattern[kind],
               std::stoi(pattern.substr(kind + 1, end - kind - 1)));
    any = any || value != kMissing;
    text += value;
    at = end;
  }
  return text;
}

/** Rows below one path of the runs' JSON, without those for which no run has a figure. */
void appendRows(const Json& runs, const std::string& title, const std::string& path,
                const std::vector<ReportRow>& rows, std::string& text) {
  for (const ReportRow& row : rows) {
    std::string line = "| " + title + ": " + row.label + " |";
    bool in_any_run = false;
    for (const Json& run : runs) {
      bool in_run = false;
      const std::string value = cell(run, path, row.pattern, in_run);
      line += " " + (in_run ? value : kMissing) + " |";
      in_any_run = in_any_run || in_run;
    }
    if (in_any_run) text += line + "\n";
  }
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

bool anyLoops(const Json& runs, const std::string& path) {
  return std::any_of(runs.begin(), runs.end(), [&](const Json& run) {
    return run.contains(Pointer(path)) && run.at(Pointer(path + "/generated/accepted")) > 0;
  });
}

/** Loops of all robots; those within and between robots too if there are both. */
void appendLoops(const Json& runs, std::string& text) {
  const bool apart =
      anyLoops(runs, "/loops/within_robots") && anyLoops(runs, "/loops/between_robots");
  for (const auto& [key, title] :
       {std::pair("all", "loops"), std::pair("within_robots", "loops within robots"),
        std::pair("between_robots", "loops between robots")}) {
    const std::string path = std::string("/loops/") + key;
    for (const char* stage : {"generated", "verified", "kept"})
      appendRows(runs, std::string(title) + " " + stage, path + "/" + stage, kStageRows, text);
    appendRows(runs, std::string(title) + " kept, error", path, kLoopErrorRows, text);
    appendRows(runs, std::string(title) + " kept, covariance", path + "/covariance",
               kCovarianceRows, text);
    if (!apart) return;
  }
}

void appendRelations(const Json& runs, std::string& text) {
  for (const auto& [key, title] :
       {std::pair("all", "relations"), std::pair("below_5_s", "relations below 5 s"),
        std::pair("from_5_s", "relations from 5 s")}) {
    const std::string of = std::string("/") + key;
    appendRows(runs, title, "/relations/result" + of, kRelationRows, text);
    appendRows(runs, std::string(title) + ", odometry", "/relations/odometry" + of, kRelationRows,
               text);
  }
}

std::string tableRows(const Json& runs) {
  std::string text;
  appendRows(runs, "all robots", "/trajectories/all", kTrajectoryRows, text);
  const auto robots = keysOf(runs, "/trajectories/robots");
  if (robots.size() > 1)
    for (const std::string& robot : robots)
      appendRows(runs, robot, "/trajectories/robots/" + robot, kTrajectoryRows, text);
  appendRows(runs, "odometry edges", "/odometry_edges", kCovarianceRows, text);
  appendLoops(runs, text);
  for (const std::string& map : keysOf(runs, "/maps"))
    appendRows(runs, map, "/maps/" + map, kMapRows, text);
  appendRows(runs, "octomap", "/octomap", kOctoMapRows, text);
  appendRelations(runs, text);
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
            "`: " + report.at("alignment_meaning").get<std::string>() +
            ". Figures of the odometry in brackets.\n\n";
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

}  // namespace lamp::evaluation
