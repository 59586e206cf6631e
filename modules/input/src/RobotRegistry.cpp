#include "RobotRegistry.h"

#include <mrpt/obs/CObservation.h>

#include <algorithm>
#include <stdexcept>

#include "lamp/input/OdometryFromObservation.h"
#include "lamp/input/ScanFromObservation.h"

namespace lamp {
namespace {

char letterOf(const RobotOptions& robot) {
  if (robot.key.empty()) return 0;
  if (robot.key.size() == 1 && robot.key[0] >= 'a' && robot.key[0] <= 'z') return robot.key[0];
  throw std::runtime_error("[robot." + robot.name + "] key = " + robot.key +
                           ": must be one letter from a to z");
}

}  // namespace

RobotRegistry::RobotRegistry(const std::vector<RobotOptions>& robots, RobotTable& table)
    : table_(table) {
  for (const RobotId known : table.ids()) {
    RobotOptions options;
    options.name = table.name(known);
    enter(known, options);
  }
  for (const RobotOptions& robot : robots) enter(table.add(robot.name, letterOf(robot)), robot);
}

void RobotRegistry::enter(RobotId robot, const RobotOptions& options) {
  options_.push_back(options);
  RobotReport report;
  report.robot = robot;
  report.name = options.name;
  reports_.push_back(report);
}

RobotId RobotRegistry::claim(const std::string& name, const std::string& path) {
  auto robot = table_.find(name);
  if (!robot) {
    robot = table_.add(name);
    RobotOptions options;
    options.name = name;
    enter(*robot, options);
  }
  std::string& owner = reports_.at(robot->value).path;
  if (owner.empty()) owner = path;
  if (owner != path) {
    throw std::runtime_error("robot '" + name + "' is in two rawlogs, " + owner + " and " + path +
                             "; give each recording its robot with [robot.NAME] rawlog = FILE");
  }
  return *robot;
}

std::set<std::string> RobotRegistry::names() const {
  std::set<std::string> names;
  for (const RobotOptions& robot : options_) names.insert(robot.name);
  return names;
}

LabelReport& RobotRegistry::label(RobotId robot, const std::string& label,
                                  const mrpt::obs::CObservation& observation) {
  auto& labels = reports_.at(robot.value).labels;
  const std::string class_name = observation.GetRuntimeClass()->className;
  const auto found = std::find_if(labels.begin(), labels.end(), [&](const LabelReport& l) {
    return l.label == label && l.class_name == class_name;
  });
  if (found != labels.end()) return *found;
  LabelReport report;
  report.label = label;
  report.class_name = class_name;
  report.lidar = isLidar(observation);
  report.odometry = isOdometry(observation);
  labels.push_back(report);
  return labels.back();
}

}  // namespace lamp
