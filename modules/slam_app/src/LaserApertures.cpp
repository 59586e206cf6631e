#include "LaserApertures.h"

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <algorithm>

#include "lamp/core/Progress.h"
#include "lamp/input/RawlogSource.h"

namespace lamp {

namespace {

/** A robot whose first observations show no 2D laser has none. */
constexpr size_t kFirstObservations = 200;
/** Long enough for any robot to turn; seconds of the recording. */
constexpr double kLongestS = 900;

}  // namespace

std::map<RobotId, ApertureSurvey::Correction> measureApertures(
    const SlamConfig& config, const std::atomic<bool>& interrupted) {
  std::map<RobotId, ApertureSurvey::Correction> result;
  if (config.frontend.scan.laser_aperture_deg > 0) return result;
  RobotTable robots;
  RawlogSource source(config.input.rawlogs, config.robots, robots);
  std::map<RobotId, ApertureSurvey> surveys;
  bool any_laser = false;
  std::optional<double> begin;
  Progress progress;
  for (size_t count = 0; !interrupted && (any_laser || count < kFirstObservations); ++count) {
    const auto observation = source.next();
    if (!observation) break;
    if (!begin) begin = observation->stamp;
    any_laser = any_laser || dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(
                                 observation->observation.get());
    surveys[observation->robot].observe(*observation);
    const bool all = std::all_of(surveys.begin(), surveys.end(),
                                 [](const auto& survey) { return survey.second.decided(); });
    if ((all && count > kFirstObservations) || observation->stamp - *begin > kLongestS) break;
    if (progress.due())
      progress.show(std::max(source.progress(), (observation->stamp - *begin) / kLongestS),
                    "first look at what the 2D lasers see");
  }
  for (const auto& [robot, survey] : surveys)
    if (const auto correction = survey.correction()) result.emplace(robot, *correction);
  return result;
}

}  // namespace lamp
