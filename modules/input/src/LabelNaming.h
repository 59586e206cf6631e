#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace lamp {

/** Tells the robot's part of a recording's sensor labels from other slashes.
 *
 * The part before the first slash is a robot if the ini has a robot of that name, or if at the
 * beginning of the recording both a lidar and odometry have it: `husky1/points`, `husky1/odom`, but
 * not `velodyne/points`, `imu/data`. */
class LabelNaming {
 public:
  /** Reads the beginning of the recording.
   *  \param named_by robots whose options name this rawlog. \param robots of the ini.
   *  \throws std::runtime_error if the file cannot be read, or holds several robots while the ini
   *  gives it to one that is none of them. */
  LabelNaming(std::string path, std::vector<std::string> named_by, std::set<std::string> robots);

  /** The robot's name and the label without it.
   *  \throws std::runtime_error if the ini gives the file to several robots, and the label does not
   *  say to which it belongs. */
  std::pair<std::string, std::string> operator()(const std::string& sensor_label) const;

 private:
  /** What has one first part of the label; an empty one if there is no slash. */
  struct Kinds {
    bool lidar = false;
    bool odometry = false;
  };

  void survey();
  void chooseOwner();
  bool isRobot(const std::string& part) const;

  const std::string path_;
  const std::vector<std::string> named_by_;
  const std::set<std::string> robots_;
  std::map<std::string, Kinds> parts_;
  std::set<std::string> found_;  ///< parts that are robots
  std::string owner_;            ///< whose everything is; empty if the labels tell
};

}  // namespace lamp
