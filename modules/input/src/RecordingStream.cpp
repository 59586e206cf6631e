#include "RecordingStream.h"

#include <algorithm>
#include <tuple>

#include "ExternalStorage.h"

namespace lamp {

RecordingStream::RecordingStream(const std::string& path, std::vector<std::string> named_by,
                                 RobotRegistry& registry)
    : path_(path),
      external_folder_(externalStorageFolder(path)),
      registry_(registry),
      naming_(path, std::move(named_by), registry.names()),
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
    at_end_ = true;
  }
  while (const auto observation = unpacker_.pop()) accept(observation);
  if (!at_end_) return;
  for (auto& [robot, clock] : clocks_) clock.finish();
  sorter_.close();
}

void RecordingStream::accept(const mrpt::obs::CObservation::Ptr& observation) {
  InputObservation input;
  std::string robot;
  std::tie(robot, input.label) = naming_(observation->sensorLabel);
  input.robot = registry_.claim(robot, path_);
  input.stamp = mrpt::Clock::toDouble(observation->timestamp);
  input.observation = observation;
  LabelReport& label = registry_.label(input.robot, input.label, *observation);
  if (!chosen(input.robot, label)) {
    ++label.left_out;
    return;
  }
  if (!loadExternalData(*observation, external_folder_)) {
    ++label.unloadable;
    return;
  }
  clockOf(input.robot).take(input);
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

RobotClock& RecordingStream::clockOf(RobotId robot) {
  return clocks_.try_emplace(robot, robot, sorter_, registry_).first->second;
}

}  // namespace lamp
