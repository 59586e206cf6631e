#include "lamp/evaluation/RunFiles.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "lamp/core/Files.h"

namespace lamp::evaluation {

namespace {

using Json = nlohmann::json;

Json readSummary(const RunFolder& folder) {
  if (!std::filesystem::is_directory(folder.root()))
    throw std::runtime_error("there is no run folder '" + folder.root() + "'");
  if (!std::filesystem::exists(folder.summary()))
    throw std::runtime_error(
        "'" + folder.root() +
        "' has no summary.json: it is not a run folder of lamp-slam, or the run "
        "was killed or is still going on");
  try {
    return Json::parse(readTextFile(folder.summary()));
  } catch (const Json::exception& error) {
    throw std::runtime_error("'" + folder.summary() + "' is not valid JSON: " + error.what());
  }
}

/** The first component that names the robot; a robot that none names has one of its own. */
size_t componentOf(const std::string& robot, std::vector<RunFiles::Component>& components,
                   const Json& summary) {
  size_t rank = 0;
  for (const Json& component : summary.at("components")) {
    const Json& names = component.at("robots");
    if (std::find(names.begin(), names.end(), robot) != names.end()) break;
    ++rank;
  }
  if (rank == components.size()) components.emplace_back();
  components[rank].robots.push_back(robot);
  return rank;
}

void fill(const Json& summary, RunFiles& run) {
  run.interrupted = summary.value("interrupted", false);
  for (const Json& component : summary.at("components"))
    run.components.push_back(
        {run.folder.root() + "/" + component.at("map").get<std::string>(), {}});
  for (const Json& robot : summary.at("robots")) {
    const std::string name = robot.at("name");
    if (!std::filesystem::exists(run.folder.trajectory(name))) continue;
    run.robots.push_back(
        {name, robot.value("planar", false), componentOf(name, run.components, summary)});
  }
}

}  // namespace

RunFiles RunFiles::open(const std::string& root) {
  RunFiles run;
  run.folder = RunFolder(root);
  const Json summary = readSummary(run.folder);
  try {
    fill(summary, run);
  } catch (const Json::exception& error) {
    throw std::runtime_error("'" + run.folder.summary() +
                             "' is not the summary of a run: " + error.what());
  }
  if (run.robots.empty())
    throw std::runtime_error("'" + root + "' has no trajectories/<robot>.tum to evaluate");
  return run;
}

}  // namespace lamp::evaluation
