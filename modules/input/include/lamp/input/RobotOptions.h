#pragma once

#include <string>
#include <vector>

#include "lamp/core/Options.h"

namespace lamp {

/** What the ini's section `[robot.NAME]` says of one robot. */
struct RobotOptions {
  std::string name;  ///< NAME of the section; no key of its own

  std::string rawlog;
  std::string key;
  std::string calibration = "none";
  std::vector<double> start_pose;
  double start_sigma_xyz_m = 0;
  double start_sigma_rot_deg = 0;
  std::string odometry_file;
  std::string odometry_label;
  std::vector<std::string> lidar_labels;
  std::string arrivals;
  int beacon_id = -1;
  std::vector<double> beacon_position;

  bool startsAtGate() const { return calibration == "gate"; }

  void visit(OptionVisitor& v);
};

/** What the ini's section `[beacon.NAME]` says of a radio beacon that stands somewhere. */
struct BeaconOptions {
  std::string name;  ///< NAME of the section; no key of its own

  int id = -1;
  std::vector<double> position;

  void visit(OptionVisitor& v);
};

}  // namespace lamp
