#include "lamp/input/RawlogSource.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "InputWarnings.h"
#include "RecordingStream.h"
#include "TrajectoryStream.h"

namespace lamp {
namespace {

struct Recording {
  std::string path;
  std::vector<std::string> named_by;
};

bool sameFile(const std::string& a, const std::string& b) {
  std::error_code error;
  return a == b || std::filesystem::equivalent(a, b, error);
}

Recording& findOrAdd(std::vector<Recording>& recordings, const std::string& path) {
  const auto found = std::find_if(recordings.begin(), recordings.end(),
                                  [&](const Recording& r) { return sameFile(r.path, path); });
  if (found != recordings.end()) return *found;
  recordings.push_back({path, {}});
  return recordings.back();
}

/** Each file once, with the robots whose options name it. */
std::vector<Recording> recordingsOf(const std::vector<std::string>& rawlogs,
                                    const std::vector<RobotOptions>& robots) {
  std::vector<Recording> recordings;
  for (const RobotOptions& robot : robots) {
    if (!robot.rawlog.empty()) {
      findOrAdd(recordings, robot.rawlog).named_by.push_back(robot.name);
    }
  }
  for (const std::string& rawlog : rawlogs) findOrAdd(recordings, rawlog);
  if (recordings.empty()) {
    throw std::runtime_error("no rawlog: name one on the command line or by [robot.NAME] rawlog =");
  }
  return recordings;
}

}  // namespace

RawlogSource::RawlogSource(const std::vector<std::string>& rawlogs,
                           const std::vector<RobotOptions>& robots, RobotTable& table)
    : registry_(std::make_unique<RobotRegistry>(robots, table)) {
  // Odometry files first: at equal stamps a pose comes before the scan that it belongs to.
  for (const RobotOptions& robot : robots) {
    if (robot.odometry_file.empty()) continue;
    streams_.push_back(std::make_unique<TrajectoryStream>(registry_->id(robot.name),
                                                          robot.odometry_file, *registry_));
  }
  for (const Recording& recording : recordingsOf(rawlogs, robots)) {
    streams_.push_back(
        std::make_unique<RecordingStream>(recording.path, recording.named_by, *registry_));
  }
  for (const auto& stream : streams_) stream->nextStamp();
}

RawlogSource::~RawlogSource() = default;

std::optional<InputObservation> RawlogSource::next() {
  InputStream* earliest = nullptr;
  double earliest_stamp = 0;
  for (const auto& stream : streams_) {
    const auto stamp = stream->nextStamp();
    if (!stamp || (earliest && *stamp >= earliest_stamp)) continue;
    earliest = stream.get();
    earliest_stamp = *stamp;
  }
  if (!earliest) return {};
  return earliest->pop();
}

double RawlogSource::progress() const {
  double sum = 0;
  for (const auto& stream : streams_) sum += stream->progress();
  return sum / static_cast<double>(streams_.size());
}

std::vector<RecordingReport> RawlogSource::recordings() const {
  std::vector<RecordingReport> reports;
  for (const auto& stream : streams_) {
    if (auto report = stream->report()) reports.push_back(std::move(*report));
  }
  return reports;
}

const std::vector<RobotReport>& RawlogSource::robots() const {
  return registry_->reports();
}

std::vector<std::string> RawlogSource::warnings() const {
  std::vector<std::string> warnings;
  const auto add = [&](const std::vector<std::string>& more) {
    warnings.insert(warnings.end(), more.begin(), more.end());
  };
  for (const RecordingReport& recording : recordings()) add(recordingWarnings(recording));
  for (const RobotReport& robot : robots()) {
    add(robotWarnings(robot, registry_->options(robot.robot)));
  }
  return warnings;
}

}  // namespace lamp
