#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "RobotRegistry.h"
#include "TimeSorter.h"

namespace lamp {

/** Judges the stamps of one robot's observations in one file and passes on those that are in order.
 *
 * Within a label and class, stamps must grow. Where one does not, either it is wrong, or those
 * before it were: a stamp that lies ahead of all that is recorded around it is taken back. Where
 * the stamps of all sensors fall behind and stay there, the clock was set back; time then goes on
 * from where it was. */
class RobotClock {
 public:
  /** \param sorter gets what is good. \param registry gets the counts. Both outlive the clock. */
  RobotClock(RobotId robot, TimeSorter& sorter, RobotRegistry& registry)
      : robot_(robot), sorter_(sorter), registry_(registry) {}

  /** Observations in file order. */
  void take(InputObservation observation);
  /** No more will come. */
  void finish();

 private:
  /** What one sensor has given so far. */
  struct Track {
    double first = 0;
    std::optional<double> beside;  ///< the first stamp since the last lidar scan
    ClockComparison clock;
    std::deque<TimeSorter::Key> recent;  ///< the last ones that were passed on
    std::vector<InputObservation> held;  ///< behind those, in file order
  };

  void pass(Track& track, const InputObservation& observation);
  void hold(Track& track, const InputObservation& observation);
  bool takeBack(Track& track, double stamp);
  void release(Track& track);
  void drop(Track& track);
  void setBack();
  double stepBack() const;

  LabelReport& report(const InputObservation& observation);
  void compare(Track& track, const InputObservation& observation);

  const RobotId robot_;
  TimeSorter& sorter_;
  RobotRegistry& registry_;
  std::map<std::pair<std::string, std::string>, Track> tracks_;  ///< by label and class
  RecentMedian seen_;
  std::optional<double> lidar_;  ///< stamp of the last lidar scan
  size_t held_ = 0;              ///< in all tracks
  size_t in_order_ = 0;          ///< passed on while something is held
  bool copied_ = false;          ///< what falls behind repeats the beginning of the recording
  double offset_ = 0;            ///< seconds, from the recorded stamps
};

}  // namespace lamp
