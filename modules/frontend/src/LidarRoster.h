#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/input/ObservationSource.h"

namespace lamp {

/** The lidars of a robot: which they are, where they are mounted, and whether they still speak.
 *
 * Two lidars that a recording gives one label are told apart by where they are mounted; a lidar on
 * a mount that turns or nods is one lidar in many places. */
class LidarRoster {
 public:
  /** Any observation of the robot, in time order. \return the same; of lidars that share a label,
   * all but the first one seen with a number behind it. */
  InputObservation take(InputObservation observation);
  /** True if a lidar has given nothing for long at `stamp`, seconds, UTC. */
  bool isSilent(const std::string& name, double stamp) const;
  /** Stamp of what it gave last. */
  double lastOf(const std::string& name) const { return lidars_.at(name).last; }
  /** Its silence is told of elsewhere. */
  void excuse(const std::string& name) { lidars_.at(name).excused = true; }
  /** What a user should know, in words. */
  std::vector<std::string> warnings() const;

 private:
  struct Mount {
    Pose3 base_T_sensor = Pose3::Identity();
    int turns = 0;  ///< times that it spoke after another one
  };
  struct Label {
    std::vector<Mount> mounts;
    std::optional<size_t> last;  ///< mount
    bool moves = false;          ///< seen in more places than lidars share a label
    bool shared() const;
  };
  struct Lidar {
    Pose3 base_T_sensor = Pose3::Identity();  ///< of its first scan
    double last = 0;                          ///< stamp
    std::map<std::string, double> heard;      ///< talk of each label until then
    std::optional<double> interval_s;         ///< between its scans
    double silent_s = 0;                      ///< in all, while others spoke
    std::optional<double> first_silent;       ///< stamp
    bool excused = false;
  };

  /** For how long a sensor has talked, by its own clock and without pauses. */
  struct Voice {
    double last = 0;  ///< stamp
    double talk_s = 0;
  };

  void hear(const InputObservation& observation);
  double talkSince(const Lidar& lidar) const;
  std::string nameOf(const InputObservation& observation, const Pose3& base_T_sensor);
  void noteScan(Lidar& lidar, double stamp);
  static double longestPause(const Lidar& lidar);
  void noteSilence(Lidar& lidar) const;
  std::vector<std::string> mountWarnings() const;

  std::map<std::string, Label> labels_;
  std::map<std::string, Lidar> lidars_;  ///< by name
  std::map<std::string, Voice> voices_;  ///< by label, of sensors of any kind
};

}  // namespace lamp
