#include "TeamLocalizer.h"

#include <memory>
#include <stdexcept>
#include <utility>

#include "MapRegistration.h"
#include "lamp/scans/Cloud.h"

namespace lamp {

namespace {

/** A robot is sought again where it has come so far since, and so often at most. */
constexpr double kSearchEveryM = 5;
constexpr int kMostSearches = 10;
/** How often it is checked whether the robot is where it is believed to be, as long as nobody
 * knows.
 */
constexpr double kCheckEveryM = 2;
/** A view of the survey that leads so near confirms the pose, and one that leads so far corrects
 * it, if the scan shares as much with the view. */
constexpr double kConfirmedM = 0.2, kElsewhereM = 0.5, kElsewhereOverlap = 0.7;
/** A robot that was lost for so many scans may have been found again elsewhere. */
constexpr size_t kLost = 5;

bool isDue(const std::optional<Pose3>& last, const Pose3& now, double distance_m) {
  return !last || (last->inverse() * now).translation().norm() >= distance_m;
}

Eigen::Vector3f viewpointOf(const Scan& scan) {
  return scan.sensors.front().position.cast<float>();
}

}  // namespace

bool TeamLocalizer::send(Message message) {
  if (const auto* packet = std::get_if<KeyNodePacket>(&message)) localize(*packet);
  return true;
}

void TeamLocalizer::localize(const KeyNodePacket& packet) {
  if (packet.planar)
    throw std::runtime_error(
        "a robot has a level 2D laser only: its height and tilt in a survey cannot be told, and "
        "lamp-localize needs lidars that see in space");
  Robot& robot = robots_[packet.id.robot];
  results_[packet.id.robot].stamps.push_back(packet.stamp);
  if (robot.localizer)
    robot.localizer->predict(*packet.odometry);
  else if (const auto start = packet.prior ? packet.prior : sought(packet, robot))
    robot.localizer.emplace(*survey_.map, *start);
  if (robot.localizer) locate(packet, robot);
}

void TeamLocalizer::locate(const KeyNodePacket& packet, Robot& robot) {
  if (!robot.localizer->correct(packet.scan->points)) {
    if (++robot.lost_in_a_row < kLost) return;
    robot.confirmed = false;
    robot.unconfirmed.clear();
    return;
  }
  robot.lost_in_a_row = 0;
  Pose3 world_T_base = robot.localizer->pose();
  world_T_base.pretranslate(survey_.world_p_origin);
  robot.unconfirmed.push_back({{packet.stamp, world_T_base},
                               robot.localizer->matchedShare(),
                               robot.localizer->deviation()});
  if (!robot.confirmed) check(packet, robot);
  if (!robot.confirmed) return;
  localized_ += robot.unconfirmed.size();
  auto& scans = results_[packet.id.robot].scans;
  scans.insert(scans.end(), robot.unconfirmed.begin(), robot.unconfirmed.end());
  robot.unconfirmed.clear();
}

/** Whether the robot is where it is believed to be; or elsewhere, as a view of the survey shows. */
void TeamLocalizer::check(const KeyNodePacket& packet, Robot& robot) {
  if (!isDue(robot.checked_at, packet.odom_T_base, kCheckEveryM)) return;
  robot.checked_at = packet.odom_T_base;
  const Pose3 pose = robot.localizer->pose();
  const MapVerification seen =
      verifyOnMap(prepared(packet.scan), viewpointOf(*packet.scan), pose, survey_.points, config_);
  if (!seen.attempt.accepted) return;
  const Pose3& refined = seen.attempt.result.target_T_source;
  const double apart = (pose.inverse() * refined).translation().norm();
  if (apart > kElsewhereM && seen.overlap >= kElsewhereOverlap) {
    robot.unconfirmed.clear();
    robot.localizer.emplace(*survey_.map, StartPrior{refined, Matrix6d::Zero()});
    return;
  }
  robot.confirmed = apart < kConfirmedM && robot.localizer->observed() &&
                    robot.localizer->matchedShare() >= confirming_share_;
}

/** In the whole survey. */
std::optional<StartPrior> TeamLocalizer::sought(const KeyNodePacket& packet, Robot& robot) {
  if (robot.searches == kMostSearches || !isDue(robot.sought_at, packet.odom_T_base, kSearchEveryM))
    return std::nullopt;
  ++robot.searches;
  robot.sought_at = packet.odom_T_base;
  const LoopClosureAttempt found =
      registerOnMap(prepared(packet.scan), viewpointOf(*packet.scan), survey_.points, config_)
          .attempt;
  results_[packet.id.robot].not_found = found.accepted ? "" : found.stage + ": " + found.reason;
  if (!found.accepted) return std::nullopt;
  return StartPrior{found.result.target_T_source, Matrix6d::Zero()};
}

PreparedScan TeamLocalizer::prepared(const KeyedScanPtr& scan) const {
  const PreparationOptions& options = config_.registration.preparation;
  return PreparedScan(accumulate({{scan, Pose3::Identity()}}, options.accumulate_voxel_m),
                      options.scan, false);
}

}  // namespace lamp
