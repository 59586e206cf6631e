#include "TeamArrivals.h"

#include <algorithm>
#include <stdexcept>

namespace lamp {

namespace {

bool hasLidar(const RobotReport& robot) {
  return std::any_of(robot.labels.begin(), robot.labels.end(),
                     [](const LabelReport& label) { return label.lidar; });
}

}  // namespace

std::map<RobotId, ArrivalTimes> readTeamArrivals(const SlamConfig& config) {
  // The robots of the ini come first in the robot table, in the ini's order.
  std::map<RobotId, ArrivalTimes> arrivals;
  for (const RobotOptions& robot : config.robots)
    arrivals.emplace(RobotId{static_cast<uint16_t>(arrivals.size())}, readArrivals(robot.arrivals));
  return arrivals;
}

void requireArrivals(const SlamConfig& config, const std::vector<RobotReport>& robots) {
  if (!config.input.inArrivalOrder()) return;
  std::string missing;
  for (size_t i = config.robots.size(); i < robots.size(); ++i)
    if (hasLidar(robots[i])) missing += (missing.empty() ? "" : ", ") + robots[i].name;
  if (!missing.empty())
    throw std::runtime_error(
        "[input] order = arrival: the recordings hold robots without a "
        "section [robot.NAME] that names their arrivals: " +
        missing);
}

}  // namespace lamp
