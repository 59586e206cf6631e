#include "ScanMerger.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <vector>

#include "Undistortion.h"

namespace lamp {

namespace {

/** The place of a scan's one lidar among the target's: pieces of one sweep share a lidar. */
uint8_t sensorFor(const SensorOrigin& origin, Scan& target) {
  const auto same =
      std::find_if(target.sensors.begin(), target.sensors.end(),
                   [&](const SensorOrigin& other) { return other.label == origin.label; });
  if (same != target.sensors.end()) return static_cast<uint8_t>(same - target.sensors.begin());
  target.sensors.push_back(origin);
  return static_cast<uint8_t>(target.sensors.size() - 1);
}

/** \param age of the scan's stamp against the target's, seconds; negative if it is older. */
void append(const Scan& scan, const Pose3& target_T_scan, double age, Scan& target) {
  SensorOrigin origin = scan.sensors.front();
  origin.position = target_T_scan * origin.position;
  const uint8_t sensor = sensorFor(origin, target);
  const bool keep_time = scan.hasTimes() || target.hasTimes();
  if (keep_time && !target.hasTimes()) target.time.assign(target.size(), 0.0f);
  const bool keep_intensity =
      scan.hasIntensity() && (target.hasIntensity() || target.points.empty());
  const Eigen::Isometry3f T = target_T_scan.cast<float>();
  for (size_t i = 0; i < scan.size(); ++i) {
    target.points.push_back(T * scan.points[i]);
    target.sensor.push_back(sensor);
    if (keep_time)
      target.time.push_back(static_cast<float>(age) + (scan.hasTimes() ? scan.time[i] : 0.0f));
    if (keep_intensity)
      target.intensity.push_back(scan.intensity[i]);
    else if (target.hasIntensity())
      target.intensity.push_back(0.0f);
  }
}

}  // namespace

Scan ScanMerger::merge(const ScanParts& parts, const Motion& motion) {
  Scan merged;
  sweep_s_ = 0;
  for (const InputObservation& part : parts.observations) {
    try {
      auto scan = scanFromObservation(*part.observation, part.label, options_);
      if (!scan) continue;
      if (!scan->time.empty()) {
        undistort(
            scan->time, [&](double time) { return motion(part.stamp, part.stamp + time); },
            scan->points);
        sweep_s_ = std::max(sweep_s_, part.stamp - parts.stamp +
                                          *std::max_element(scan->time.begin(), scan->time.end()));
      }
      append(*scan, part.stamp == parts.stamp ? Pose3::Identity() : motion(parts.stamp, part.stamp),
             part.stamp - parts.stamp, merged);
      if (part.label == parts.observations.front().label)
        sweep_s_ = std::max(sweep_s_, part.stamp - parts.stamp);
    } catch (const std::exception& error) {  // MRPT throws logic errors for missing files
      if (unreadable_++ == 0) first_unreadable_ = error.what();
    }
  }
  return merged;
}

}  // namespace lamp
