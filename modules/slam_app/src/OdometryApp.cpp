#include "lamp/slam_app/OdometryApp.h"

#include <CLI/CLI.hpp>
#include <atomic>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>

#include "RunLogging.h"
#include "lamp/core/Files.h"
#include "lamp/core/Program.h"
#include "lamp/core/Trajectory.h"
#include "lamp/core/Version.h"
#include "lamp/slam_app/SlamRun.h"

namespace lamp {

namespace {

std::atomic<bool> interrupted{false};

struct Arguments {
  std::vector<std::string> rawlogs;
  std::string config;
  std::string out;
  std::vector<std::string> overrides;
  std::string log = "WARN";
};

void describe(CLI::App& app, Arguments& arguments) {
  app.description(
      "The front end alone: rawlogs in, one trajectory with key nodes a robot out, without loop "
      "closures.\n"
      "Example: lamp-odometry robot1.rawlog --out odometry1");
  app.set_version_flag("--version", std::string("lamp-odometry ") + kVersion);
  app.add_option("rawlogs", arguments.rawlogs, "Recordings, one or several robots")
      ->type_name("RAWLOG");
  app.add_option("--out", arguments.out, "Folder for the results; new or empty")
      ->type_name("DIR")
      ->required();
  app.add_option("--config", arguments.config, "Experiment file (see ini/); without, the defaults")
      ->type_name("CONFIG.ini");
  app.add_option("--set", arguments.overrides, "Overrides one key of the ini")
      ->type_name("SECTION.KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--log", arguments.log, "Log level: DEBUG, INFO, WARN, ERROR")
      ->capture_default_str()
      ->check(CLI::IsMember({"DEBUG", "INFO", "WARN", "ERROR"}));
}

/** The experiment without all that comes behind the front ends. */
SlamConfig frontEndsOnly(const Arguments& arguments) {
  std::vector<std::string> overrides = arguments.overrides;
  for (const char* stage : {"candidates", "outlier_rejection"})
    overrides.push_back(std::string("pipeline.") + stage + "=");
  overrides.emplace_back("pipeline.exporters=Ply,Picture");
  SlamConfig config = SlamConfig::fromFile(arguments.config, overrides, arguments.rawlogs);
  if (config.input.rawlogs.empty() && config.robots.empty())
    throw UsageError("name a recording, for example: lamp-odometry robot1.rawlog --out DIR");
  return config;
}

double lengthOf(const std::vector<StampedPose>& trajectory) {
  double length = 0;
  for (size_t i = 1; i < trajectory.size(); ++i)
    length += (trajectory[i - 1].pose.inverse() * trajectory[i].pose).translation().norm();
  return length;
}

/** What came out, from the run folder. */
std::string report(const RunFolder& folder) {
  const auto summary = nlohmann::json::parse(readTextFile(folder.summary()));
  const auto timings = nlohmann::json::parse(readTextFile(folder.timings()));
  const double seconds = timings["stages"]["run"]["seconds"];
  std::ostringstream text;
  text << std::fixed;
  double recorded = 0;
  for (const auto& robot : summary["robots"]) {
    const std::string name = robot["name"];
    const auto trajectory = readTum(folder.trajectory(name));
    const double duration = trajectory.back().stamp - trajectory.front().stamp;
    recorded += duration;
    const double length = lengthOf(trajectory);
    const double home =
        (trajectory.front().pose.translation() - trajectory.back().pose.translation()).norm();
    text << std::setprecision(1) << name << ": " << robot["scans"] << " scans, "
         << robot["key_nodes"] << " key nodes, " << length << " m in " << duration << " s, ends "
         << home << " m from its start; " << robot["scans_tracked"]
         << " scans placed by lidar odometry\n";
  }
  text << std::setprecision(1) << seconds << " s, " << recorded / std::max(seconds, 1e-9)
       << " times as fast as it was recorded: " << folder.root() << "\n";
  return text.str();
}

void run(const Arguments& arguments) {
  registerAllClasses_lamp();
  SlamRun slam(frontEndsOnly(arguments), {arguments.out, 1, {}}, interrupted);
  slam.setMinLoggingLevel(kLogLevels.at(arguments.log));
  const SlamRun::Outcome outcome = runLogged(slam);
  requireAllWritten(outcome, arguments.out);
  std::cout << report(RunFolder(arguments.out));
}

}  // namespace

int odometryApp(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("", "lamp-odometry");
  describe(app, arguments);
  return runProgram(
      app, argc, argv, [&] { run(arguments); }, &interrupted);
}

}  // namespace lamp
