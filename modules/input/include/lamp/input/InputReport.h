#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "lamp/core/Ids.h"
#include "lamp/input/RawlogReader.h"

namespace lamp {

/** How far a sensor's stamps lie from those of the lidar scans that are recorded around them. */
struct ClockComparison {
  static constexpr double kBesideS = 1.0;  ///< usual

  size_t all = 0, apart = 0;  ///< stamps; and those farther away than is usual
  double apart_s = 0;         ///< sum over the latter, seconds

  void add(double seconds) {
    ++all;
    if (std::abs(seconds) <= kBesideS) return;
    ++apart;
    apart_s += seconds;
  }
};

/** What became of the observations of one class under one label. */
struct LabelReport {
  std::string label;  ///< without the robot's part
  std::string class_name;
  bool lidar = false;
  bool odometry = false;
  size_t used = 0;
  size_t repeated = 0;                     ///< dropped: the stamp of the one before
  size_t backwards = 0;                    ///< dropped: stamp before the one before
  size_t ahead = 0;                        ///< dropped: stamp ahead of what is recorded around it
  size_t left_out = 0;                     ///< dropped: the options choose other odometry or lidars
  double first_stamp = 0, last_stamp = 0;  ///< of those used, seconds, UTC
  size_t unloadable = 0;                   ///< dropped: the file with its data cannot be loaded
  ClockComparison clock;

  void use(double stamp) {
    if (used++ == 0) first_stamp = stamp;
    last_stamp = stamp;
  }
};

/** A robot's clock was set back within a recording. */
struct ClockStep {
  double stamp = 0;    ///< seconds, UTC, of the first observation after it, moved on
  double seconds = 0;  ///< that were added to its stamp and all that follow
};

struct RobotReport {
  RobotId robot;
  std::string name;
  std::string path;                 ///< the rawlog its observations come from; empty if none came
  std::vector<LabelReport> labels;  ///< in order of appearance
  std::vector<ClockStep> clock_steps;
};

struct RecordingReport {
  RawlogReport file;
  size_t without_stamp = 0;  ///< observations that were dropped because they have no stamp
};

}  // namespace lamp
