#include "LaserApertures.h"

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <algorithm>
#include <vector>

#include "lamp/core/Progress.h"
#include "lamp/input/RawlogSource.h"

namespace lamp {

namespace {

/** A robot whose first observations show no 2D laser has none. */
constexpr size_t kFirstObservations = 200;
/** Long enough for any robot to turn; seconds of its recording. */
constexpr double kLongestS = 900;

struct Survey {
  ApertureSurvey apertures;
  double begin = 0;  ///< stamp of the first observation
  bool over = false;

  void observe(const InputObservation& observation) {
    if (over) return;
    apertures.observe(observation);
    over = apertures.decided() || observation.stamp - begin > kLongestS;
  }
};

/** A second session may begin hours after the first one. */
bool allHaveBegun(const RawlogSource& source, const std::map<RobotId, Survey>& surveys) {
  const std::vector<RobotReport>& robots = source.robots();
  return std::all_of(robots.begin(), robots.end(), [&](const RobotReport& robot) {
    return robot.path.empty() || surveys.count(robot.robot) > 0;
  });
}

}  // namespace

std::map<RobotId, ApertureSurvey::Correction> measureApertures(
    const SlamConfig& config, const std::atomic<bool>& interrupted) {
  std::map<RobotId, ApertureSurvey::Correction> result;
  if (config.frontend.scan.laser_aperture_deg > 0) return result;
  RobotTable robots;
  RawlogSource source(config.input.rawlogs, config.robots, robots);
  std::map<RobotId, Survey> surveys;
  bool any_laser = false;
  Progress progress;
  for (size_t count = 0; !interrupted && (any_laser || count < kFirstObservations); ++count) {
    const auto observation = source.next();
    if (!observation) break;
    any_laser = any_laser || dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(
                                 observation->observation.get());
    const auto [survey, is_new] = surveys.try_emplace(observation->robot);
    if (is_new) survey->second.begin = observation->stamp;
    survey->second.observe(*observation);
    const bool all = std::all_of(surveys.begin(), surveys.end(),
                                 [](const auto& entry) { return entry.second.over; });
    if (all && count > kFirstObservations && allHaveBegun(source, surveys)) break;
    if (progress.due()) progress.show(source.progress(), "first look at what the 2D lasers see");
  }
  for (const auto& [robot, survey] : surveys)
    if (const auto correction = survey.apertures.correction()) result.emplace(robot, *correction);
  return result;
}

}  // namespace lamp
