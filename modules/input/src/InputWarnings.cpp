#include "InputWarnings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lamp/core/Csv.h"

namespace lamp {
namespace {

using Labels = std::vector<LabelReport>;

/** Sensors of one recording are not that far apart in time, seconds. */
constexpr double kApartS = 10.0;
/** So many comparisons tell that a clock is another one, if nearly all agree. */
constexpr size_t kFewestCompared = 5;
constexpr double kNearlyAll = 0.9;

std::string counted(size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

template <class Predicate>
std::string listLabels(const Labels& labels, Predicate predicate) {
  std::string list;
  for (const LabelReport& label : labels) {
    if (!predicate(label)) continue;
    list += (list.empty() ? "'" : ", '") + label.label + "'";
  }
  return list.empty() ? "none" : list;
}

bool isRecordedLidar(const LabelReport& label) {
  return label.lidar;
}
bool isRecordedOdometry(const LabelReport& label) {
  return label.odometry;
}

template <class Predicate>
bool hasLabel(const Labels& labels, const std::string& wanted, Predicate predicate) {
  return std::any_of(labels.begin(), labels.end(),
                     [&](const LabelReport& l) { return predicate(l) && l.label == wanted; });
}

void warnOfDrops(const LabelReport& label, const std::string& who,
                 std::vector<std::string>& warnings) {
  const std::string what = who + "label '" + label.label + "' (" + label.class_name + "): ";
  if (label.repeated > 0) {
    warnings.push_back(what + counted(label.repeated, "observation") +
                       " dropped whose stamp repeats the one before" +
                       (label.lidar ? ": do two lidars share the label?" : ""));
  }
  if (label.backwards > 0) {
    warnings.push_back(what + counted(label.backwards, "observation") +
                       " dropped whose stamp goes back in time");
  }
  if (label.ahead > 0) {
    warnings.push_back(what + counted(label.ahead, "observation") +
                       " dropped whose stamp lies ahead of all that was recorded after it");
  }
  if (label.unloadable > 0) {
    warnings.push_back(what + counted(label.unloadable, "observation") +
                       " dropped whose data file is missing or damaged");
  }
}

/** Where a recording holds its observations as they came. */
void warnOfClocks(const LabelReport& label, const std::string& who,
                  std::vector<std::string>& warnings) {
  const ClockComparison& clock = label.clock;
  if (clock.all < kFewestCompared ||
      static_cast<double>(clock.apart) < kNearlyAll * static_cast<double>(clock.all))
    return;
  const double apart = clock.apart_s / static_cast<double>(clock.apart);
  warnings.push_back(who + "label '" + label.label + "' (" + label.class_name +
                     "): stamps lie about " + formatFixed(std::abs(apart), 1) + " s " +
                     (apart > 0 ? "after" : "before") +
                     " those of the lidar scans recorded beside them: is its clock another one?");
}

void warnOfChoices(const RobotReport& robot, const RobotOptions& options, const std::string& who,
                   std::vector<std::string>& warnings) {
  for (const std::string& wanted : options.lidar_labels) {
    if (hasLabel(robot.labels, wanted, isRecordedLidar)) continue;
    warnings.push_back(who + "no lidar has the label '" + wanted + "' of lidar_labels; there are " +
                       listLabels(robot.labels, isRecordedLidar));
  }
  const std::string& wanted = options.odometry_label;
  if (!options.odometry_file.empty()) return;
  if (!wanted.empty() && !hasLabel(robot.labels, wanted, isRecordedOdometry)) {
    warnings.push_back(who + "no odometry has the label '" + wanted +
                       "' of odometry_label; there are " +
                       listLabels(robot.labels, isRecordedOdometry));
  }
  for (const LabelReport& label : robot.labels) {
    if (!label.odometry || label.left_out == 0 || !wanted.empty()) continue;
    warnings.push_back(who + "odometry with the label '" + label.label + "' (" + label.class_name +
                       ") is not used, as other odometry came first; set odometry_label to choose");
  }
}

void warnOfMissing(const RobotReport& robot, const std::string& who,
                   std::vector<std::string>& warnings) {
  const auto usesAny = [&](auto predicate) {
    return std::any_of(robot.labels.begin(), robot.labels.end(),
                       [&](const LabelReport& l) { return predicate(l) && l.used > 0; });
  };
  const auto span = [&](auto predicate) {
    std::pair<double, double> first_and_last(std::numeric_limits<double>::infinity(), 0);
    for (const LabelReport& label : robot.labels) {
      if (!predicate(label) || label.used == 0) continue;
      first_and_last.first = std::min(first_and_last.first, label.first_stamp);
      first_and_last.second = std::max(first_and_last.second, label.last_stamp);
    }
    return first_and_last;
  };
  const auto lidar = span(isRecordedLidar), odometry = span(isRecordedOdometry);
  if (usesAny(isRecordedLidar) && usesAny(isRecordedOdometry) &&
      (lidar.first > odometry.second + kApartS || odometry.first > lidar.second + kApartS)) {
    warnings.push_back(who + "lidars have stamps from " + formatFixed(lidar.first, 3) + " to " +
                       formatFixed(lidar.second, 3) + " s, odometry from " +
                       formatFixed(odometry.first, 3) + " to " + formatFixed(odometry.second, 3) +
                       " s: check that both are of the same recording, clock and unit");
  }
  if (!usesAny(isRecordedLidar)) warnings.push_back(who + "no lidar scan");
  if (!usesAny(isRecordedOdometry)) warnings.push_back(who + "no odometry");
}

}  // namespace

std::vector<std::string> recordingWarnings(const RecordingReport& recording) {
  std::vector<std::string> warnings;
  const RawlogReport& file = recording.file;
  for (const std::string& message : file.messages) warnings.push_back(file.path + ": " + message);
  for (const auto& [name, count] : file.unknown_classes) {
    warnings.push_back(file.path + ": " + counted(count, "object") + " of the unknown class " +
                       name + " skipped; load the plugin that defines it, if you need them");
  }
  if (file.damaged_objects > 0) {
    warnings.push_back(file.path + ": " + counted(file.damaged_objects, "object") +
                       " could not be read; " + std::to_string(file.objects) + " were read, " +
                       counted(file.bytes_skipped, "byte") + " skipped");
  }
  if (recording.without_stamp > 0) {
    warnings.push_back(file.path + ": " + counted(recording.without_stamp, "observation") +
                       " dropped for lack of a stamp");
  }
  return warnings;
}

std::vector<std::string> robotWarnings(const RobotReport& robot, const RobotOptions& options) {
  std::vector<std::string> warnings;
  const std::string who = "robot '" + robot.name + "': ";
  if (robot.labels.empty()) {
    warnings.push_back(who + "no observation: no recording belongs to it, by option or by label");
    return warnings;
  }
  for (const LabelReport& label : robot.labels) {
    warnOfDrops(label, who, warnings);
    warnOfClocks(label, who, warnings);
  }
  for (const ClockStep& step : robot.clock_steps) {
    warnings.push_back(who + "the clock was set back within the recording: from " +
                       formatFixed(step.stamp, 3) + " on, all stamps are taken " +
                       formatFixed(step.seconds, 3) + " s later than they are recorded");
  }
  warnOfChoices(robot, options, who, warnings);
  warnOfMissing(robot, who, warnings);
  return warnings;
}

}  // namespace lamp
