#include "LabelNaming.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "ObservationUnpacker.h"
#include "lamp/core/Ids.h"
#include "lamp/input/OdometryFromObservation.h"
#include "lamp/input/RawlogReader.h"
#include "lamp/input/ScanFromObservation.h"

namespace lamp {

namespace {

/** Of the recording's observations: enough for each sensor to have spoken. */
constexpr size_t kFewest = 200, kMost = 2000;

std::string firstPart(const std::string& sensor_label) {
  const size_t slash = sensor_label.find('/');
  return slash == std::string::npos ? "" : sensor_label.substr(0, slash);
}

}  // namespace

LabelNaming::LabelNaming(std::string path, std::vector<std::string> named_by,
                         std::set<std::string> robots)
    : path_(std::move(path)), named_by_(std::move(named_by)), robots_(std::move(robots)) {
  survey();
  for (const auto& [part, kinds] : parts_)
    if (isRobot(part)) found_.insert(part);
  chooseOwner();
}

void LabelNaming::survey() {
  RawlogReader reader(path_);
  ObservationUnpacker unpacker;
  const auto allAreRobots = [&] {
    return std::all_of(parts_.begin(), parts_.end(),
                       [](const auto& part) { return part.second.lidar && part.second.odometry; });
  };
  for (size_t count = 0; count < kMost && (count < kFewest || !allAreRobots());) {
    const auto object = reader.next();
    if (object)
      unpacker.push(object);
    else
      unpacker.finish();
    for (; const auto observation = unpacker.pop(); ++count) {
      Kinds& kinds = parts_[firstPart(observation->sensorLabel)];
      kinds.lidar = kinds.lidar || isLidar(*observation);
      kinds.odometry = kinds.odometry || isOdometry(*observation);
    }
    if (!object) return;
  }
}

bool LabelNaming::isRobot(const std::string& part) const {
  const auto kinds = parts_.find(part);
  return (kinds != parts_.end() && kinds->second.lidar && kinds->second.odometry) ||
         (!part.empty() && robots_.count(robotNameFromStem(part)) > 0);
}

void LabelNaming::chooseOwner() {
  if (named_by_.size() > 1) return;
  if (named_by_.size() == 1) {
    const std::string& name = named_by_.front();
    if (found_.count(name) > 0 && found_.size() > 1) return;
    if (found_.size() > 1)
      throw std::runtime_error(path_ + ": [robot." + name +
                               "] rawlog gives this recording to one robot, but its " +
                               "labels are those of several (" + *found_.begin() + ", " +
                               *std::next(found_.begin()) + "); name the sections after them");
    owner_ = name;
    return;
  }
  const bool only_robots = found_.size() == parts_.size();
  if (found_.empty() || (found_.size() == 1 && found_.count("") > 0))
    owner_ = robotNameFromStem(std::filesystem::path(path_).stem().string());
  else if (found_.size() == 1 && !only_robots)
    owner_ = robotNameFromStem(*found_.begin());
}

std::pair<std::string, std::string> LabelNaming::operator()(const std::string& sensor_label) const {
  const std::string part = firstPart(sensor_label);
  const std::string rest = part.empty() ? sensor_label : sensor_label.substr(part.size() + 1);
  if (!owner_.empty()) {
    const bool names_robot = found_.count(part) > 0 || robotNameFromStem(part) == owner_;
    return {owner_, names_robot ? rest : sensor_label};
  }
  if (named_by_.size() > 1 && !isRobot(part))
    throw std::runtime_error(path_ + ": assigned to several robots (" + named_by_[0] + ", " +
                             named_by_[1] + "), but the sensor label '" + sensor_label +
                             "' does not say which robot it belongs to; use labels ROBOT/SENSOR");
  const std::string name = part.empty() ? std::filesystem::path(path_).stem().string() : part;
  return {robotNameFromStem(name), rest};
}

}  // namespace lamp
