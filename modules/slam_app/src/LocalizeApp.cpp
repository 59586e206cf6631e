#include "lamp/slam_app/LocalizeApp.h"

#include <CLI/CLI.hpp>
#include <atomic>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "FrontEndTeam.h"
#include "RunLogging.h"
#include "TeamLocalizer.h"
#include "WorldFrame.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"
#include "lamp/core/Program.h"
#include "lamp/core/Progress.h"
#include "lamp/core/RunFolder.h"
#include "lamp/core/Trajectory.h"
#include "lamp/core/Version.h"
#include "lamp/input/RawlogSource.h"

namespace lamp {

namespace {

std::atomic<bool> interrupted{false};

/** A robot that starts farther from the survey has its start pose in another frame, metres. */
constexpr double kFarM = 1000;
/** Gaps to name before "and so many more". */
constexpr size_t kNamedGaps = 5;

struct Arguments {
  std::string survey;
  std::vector<std::string> rawlogs;
  std::string config;
  std::string out;
  std::vector<std::string> overrides;
  double confirming_share = 0.88;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.description(
      "Reference trajectories: each scan is registered to a surveyed map.\n"
      "Example: lamp-localize survey.ply robot1.rawlog --out reference");
  app.set_version_flag("--version", std::string("lamp-localize ") + kVersion);
  app.add_option("survey", arguments.survey, "Surveyed map: PLY or PCD, metres")
      ->type_name("SURVEY")
      ->required();
  app.add_option("rawlogs", arguments.rawlogs, "Recordings, one or several robots")
      ->type_name("RAWLOG");
  app.add_option("--out", arguments.out,
                 "Folder for <robot>.tum, one a robot, in the survey's frame, new or empty; or, of "
                 "one robot, the file itself")
      ->type_name("DIR|FILE.tum")
      ->required();
  app.add_option("--config", arguments.config,
                 "Experiment file (see ini/), for start poses among other things; without, the "
                 "defaults")
      ->type_name("CONFIG.ini");
  app.add_option("--set", arguments.overrides, "Overrides one key of the ini")
      ->type_name("SECTION.KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--confirming-share", arguments.confirming_share,
                 "So much of a scan must lie on the survey where a place is confirmed; less for "
                 "surveys that have gaps or are out of date, at the risk of wrong places")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0));
}

/** No graph gives a guess, so the aligner that seeks robots must need none. */
SlamConfig readConfig(const Arguments& arguments) {
  std::vector<std::string> overrides = arguments.overrides;
  if (arguments.config.empty())
    overrides.insert(overrides.begin(), "pipeline.initial_aligner=Teaser");
  SlamConfig config = SlamConfig::fromFile(arguments.config, overrides, arguments.rawlogs);
  if (config.input.rawlogs.empty() && config.robots.empty())
    throw UsageError(
        "name a recording, for example: lamp-localize survey.ply robot1.rawlog --out DIR");
  config.frontend.key_node_distance_m = 0;  // each scan is a key node
  return config;
}

void requireStartsNear(const Survey& survey, const SlamConfig& local) {
  for (const RobotOptions& robot : local.robots) {
    if (robot.start_pose.empty()) continue;
    const Eigen::Vector3d start = Eigen::Map<const Eigen::Vector3d>(robot.start_pose.data());
    const double distance = distanceFrom(survey, start);
    if (distance > kFarM)
      throw std::runtime_error("the start pose of robot '" + robot.name + "' lies " +
                               formatFixed(distance / 1000, 1) + " km from the survey '" +
                               survey.path + "': both must be in the same frame");
  }
}

/** Where scans in a row are missing: the stamps of the first and the last one. */
std::vector<std::pair<double, double>> gapsOf(const LocalizedRobot& robot) {
  std::vector<std::pair<double, double>> gaps;
  size_t next = 0;
  bool open = false;
  for (const double stamp : robot.stamps) {
    const bool localized =
        next < robot.scans.size() && robot.scans[next].world_T_base.stamp == stamp;
    if (localized) ++next;
    if (!localized && !open) gaps.emplace_back(stamp, stamp);
    if (!localized) gaps.back().second = stamp;
    open = !localized;
  }
  return gaps;
}

std::string describeGaps(const std::vector<std::pair<double, double>>& gaps) {
  if (gaps.empty()) return "";
  std::string text = "  left out, since the survey does not confirm where the robot is: ";
  for (size_t i = 0; i < std::min(kNamedGaps, gaps.size()); ++i)
    text += (i > 0 ? ", " : "") + formatFixed(gaps[i].first, 1) + " to " +
            formatFixed(gaps[i].second, 1);
  if (gaps.size() > kNamedGaps)
    text += " and " + std::to_string(gaps.size() - kNamedGaps) + " more times";
  return text + "\n";
}

std::string describe(const std::string& name, const LocalizedRobot& robot) {
  double share = 0, deviation_m = 0;
  for (const LocalizedScan& scan : robot.scans) {
    share += scan.matched_share / static_cast<double>(robot.scans.size());
    deviation_m += scan.deviation_m / static_cast<double>(robot.scans.size());
  }
  return name + ": " + std::to_string(robot.scans.size()) + " of " +
         std::to_string(robot.stamps.size()) + " scans localised; " + formatFixed(100 * share, 0) +
         " % of their points lie on the survey's surfaces, " + formatFixed(100 * deviation_m, 1) +
         " cm off\n" + describeGaps(gapsOf(robot));
}

/** Why none of a robot's scans was localised, and what to do. */
std::string explain(const std::string& name, const LocalizedRobot& robot) {
  const std::string who = "\n  robot '" + name + "': ";
  if (!robot.not_found.empty())
    return who + "it was not found in the survey (" + robot.not_found +
           "); give it a start pose in an ini: [robot." + name +
           "] start_pose = [x y z yaw pitch roll]";
  return who +
         "the survey does not show what its scans show from its start pose on: check the pose, "
         "that it is in the survey's frame, and that the survey is in metres; leave out the pose "
         "to have it sought; --confirming-share is for surveys that have gaps or are out of date";
}

std::vector<StampedPose> trajectoryOf(const LocalizedRobot& robot) {
  std::vector<StampedPose> poses;
  for (const LocalizedScan& scan : robot.scans) poses.push_back(scan.world_T_base);
  return poses;
}

void warn(const std::vector<std::string>& warnings, const std::string& prefix = "") {
  for (const std::string& warning : warnings)
    std::cerr << "lamp-localize: " << prefix << warning << "\n";
}

void localize(RawlogSource& source, FrontEndTeam& team, const TeamLocalizer& localizer) {
  const StdoutToStderr logs;
  Progress progress;
  while (!interrupted) {
    const auto observation = source.next();
    if (!observation || !team.observe(*observation)) break;
    if (progress.due())
      progress.show(source.progress(),
                    std::to_string(localizer.localizedScans()) + " scans localised");
  }
  team.finish();
}

/** `--out` names the file of one robot rather than a folder. */
bool isTumFile(const std::string& out) {
  return std::filesystem::path(out).extension() == ".tum";
}

/** \return the summary. \throws std::runtime_error if no robot has a trajectory, or if several have
 * one and `out` is a file. */
std::string write(const std::string& out, const RobotTable& table,
                  const std::map<RobotId, LocalizedRobot>& robots) {
  if (isTumFile(out) && robots.size() > 1)
    throw std::runtime_error("'" + out + "' is for one robot, and the recordings hold " +
                             std::to_string(robots.size()) + ": give --out a folder");
  std::string summary, missing;
  for (const auto& [id, robot] : robots) {
    const std::string& name = table.name(id);
    if (robot.scans.empty()) {
      missing += explain(name, robot);
      continue;
    }
    writeTextFile(isTumFile(out) ? out : out + "/" + name + ".tum", toTum(trajectoryOf(robot)));
    summary += describe(name, robot);
  }
  if (robots.empty())
    missing = interrupted ? " interrupted before the first one" : " the recordings hold none";
  if (summary.empty()) throw std::runtime_error("no scan could be localised:" + missing);
  if (!missing.empty()) warn({"without a trajectory:" + missing});
  return summary;
}

void run(const Arguments& arguments) {
  registerAllClasses_lamp();
  const SlamConfig config = readConfig(arguments);
  RobotTable robots;
  RawlogSource source(config.input.rawlogs, config.robots, robots);
  if (!isTumFile(arguments.out)) RunFolder::create(arguments.out);
  Survey survey = readSurvey(arguments.survey);
  const SlamConfig local = inLocalFrame(config, survey.world_p_origin);
  requireStartsNear(survey, local);
  TeamLocalizer localizer(local, survey, arguments.confirming_share);
  FrontEndTeam team(local, localizer);
  localize(source, team, localizer);
  warn(source.warnings());
  for (const FrontEndReport& report : team.reports())
    warn(report.warnings, "robot '" + robots.name(report.robot) + "': ");
  std::cout << write(arguments.out, robots, localizer.robots());
  if (interrupted) std::cout << "Interrupted: this is what was localised up to that point.\n";
}

}  // namespace

int localizeApp(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("", "lamp-localize");
  describe(app, arguments);
  return runProgram(
      app, argc, argv, [&] { run(arguments); }, &interrupted);
}

}  // namespace lamp
