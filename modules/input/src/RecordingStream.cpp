#include "RecordingStream.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "ExternalStorage.h"

namespace lamp {

RecordingStream::RecordingStream(const std::string& path, std::vector<std::string> named_by,
                                 RobotRegistry& registry)
    : path_(path),
      named_by_(std::move(named_by)),
      external_folder_(externalStorageFolder(path)),
      registry_(registry),
      reader_(path) {}

std::optional<double> RecordingStream::nextStamp() {
  while (!sorter_.ready() && !at_end_) readMore();
  if (!sorter_.ready()) return {};
  return sorter_.front().stamp;
}

std::optional<RecordingReport> RecordingStream::report() const {
  return RecordingReport{reader_.report(), unpacker_.withoutStamp()};
}

void RecordingStream::readMore() {
  if (const auto object = reader_.next()) {
    unpacker_.push(object);
  } else {
    unpacker_.finish();
    sorter_.close();
    at_end_ = true;
  }
  while (const auto observation = unpacker_.pop()) accept(observation);
}

void RecordingStream::accept(const mrpt::obs::CObservation::Ptr& observation) {
  InputObservation input;
  std::tie(input.robot, input.label) = robotAndLabel(observation->sensorLabel);
  input.stamp = mrpt::Clock::toDouble(observation->timestamp);
  input.observation = observation;
  LabelReport& label = registry_.label(input.robot, input.label, *observation);
  if (!chosen(input.robot, label)) {
    ++label.left_out;
    return;
  }
  if (!stampGrows({input.robot, input.label, label.class_name}, input.stamp, label)) return;
  if (!loadExternalData(*observation, external_folder_)) {
    ++label.unloadable;
    return;
  }
  ++label.used;
  sorter_.push(input);
}

std::pair<RobotId, std::string> RecordingStream::robotAndLabel(const std::string& sensor_label) {
  const size_t slash = sensor_label.find('/');
  const bool names_robot = slash != std::string::npos && slash > 0;
  if (!names_robot) return {registry_.claim(unnamedRobot(sensor_label), path_), sensor_label};
  const std::string robot = robotNameFromStem(sensor_label.substr(0, slash));
  return {registry_.claim(robot, path_), sensor_label.substr(slash + 1)};
}

std::string RecordingStream::unnamedRobot(const std::string& sensor_label) const {
  if (named_by_.size() > 1) {
    throw std::runtime_error(path_ + ": given for several robots (" + named_by_[0] + ", " +
                             named_by_[1] + "), but the sensor label '" + sensor_label +
                             "' does not say whose it is; use labels ROBOT/SENSOR");
  }
  if (!named_by_.empty()) return named_by_.front();
  return robotNameFromStem(std::filesystem::path(path_).stem().string());
}

bool RecordingStream::chosen(RobotId robot, const LabelReport& label) {
  const RobotOptions& options = registry_.options(robot);
  if (label.lidar) {
    const auto& wanted = options.lidar_labels;
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), label.label) != wanted.end();
  }
  if (!label.odometry) return true;
  if (!options.odometry_file.empty()) return false;
  if (!options.odometry_label.empty() && label.label != options.odometry_label) return false;
  const std::pair<std::string, std::string> kind(label.label, label.class_name);
  return odometry_.emplace(robot, kind).first->second == kind;
}

bool RecordingStream::stampGrows(const LabelKey& key, double stamp, LabelReport& label) {
  const auto [last, first_one] = last_stamp_.emplace(key, stamp);
  if (first_one) return true;
  if (stamp == last->second) {
    ++label.repeated;
    return false;
  }
  if (stamp < last->second) {
    ++label.backwards;
    return false;
  }
  last->second = stamp;
  return true;
}

}  // namespace lamp
