#pragma once

#include <set>
#include <string>
#include <vector>

#include "lamp/input/InputReport.h"
#include "lamp/input/RobotOptions.h"

namespace mrpt::obs {
class CObservation;
}

namespace lamp {

/** Who is who: gives robots to labels, finds clashes, and keeps the counts of each robot. */
class RobotRegistry {
 public:
  /** \throws std::runtime_error if names or letters clash. */
  RobotRegistry(const std::vector<RobotOptions>& robots, RobotTable& table);

  /** The robot's number, after adding it to the table if it is new.
   *  \param path the rawlog that has an observation of it.
   *  \throws std::runtime_error if another file had one. */
  RobotId claim(const std::string& name, const std::string& path);

  /** Options of the ini, or defaults. */
  const RobotOptions& options(RobotId robot) const { return options_[robot.value]; }
  RobotId id(const std::string& name) const { return *table_.find(name); }

  /** The counts of one class under one label. */
  LabelReport& label(RobotId robot, const std::string& label,
                     const mrpt::obs::CObservation& observation);
  void addClockStep(RobotId robot, const ClockStep& step) {
    reports_.at(robot.value).clock_steps.push_back(step);
  }
  /** Names of all robots of the ini. */
  std::set<std::string> names() const;
  const std::vector<RobotReport>& reports() const { return reports_; }

 private:
  void enter(RobotId robot, const RobotOptions& options);

  RobotTable& table_;
  std::vector<RobotOptions> options_;
  std::vector<RobotReport> reports_;
};

}  // namespace lamp
