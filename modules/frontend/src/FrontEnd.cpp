#include "lamp/frontend/FrontEnd.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "ApertureCheck.h"
#include "OdometryChain.h"
#include "PassedScans.h"
#include "ScanMerger.h"
#include "StandstillCheck.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Median.h"

namespace lamp {

namespace {

/** Scans wait for the odometry that follows them; if none comes, memory must not grow. */
constexpr size_t kMaxWaitingScans = 200;
/** Behind the last odometry reading a robot is taken to stand still, but not for longer. */
constexpr double kMaxExtrapolationS = 0.5;
/** While odometry stands, scans are looked at this often. */
constexpr double kStandstillLookS = 1.0;

/** Odometry that goes on behind a gap has counted on over it, most likely. */
constexpr double kGapMPerS = 0.05, kGapRadPerS = 0.25 * M_PI / 180.0;
/** A robot whose odometry has failed turns like this, about. */
constexpr double kFailedRadPerS = 10.0 * M_PI / 180.0;

/** The start pose, or where there is none the odometry's frame, may deviate this much from upright:
 * a unit that says more is mounted otherwise than the recording says. */
constexpr double kStartTiltRad = 5.0 * M_PI / 180.0, kFrameTiltRad = 45.0 * M_PI / 180.0;

/** A laser in the plane sees few points, so all are kept, and no more than a slice, so key nodes
 * are denser: they lie apart by this share of what it sees, but not less than the rest. */
constexpr double kPlanarDistanceShare = 0.1, kPlanarDistanceM = 0.5, kPlanarAngleDeg = 15.0;

/** Of points from their lidars, metres; zero of none. */
double medianRange(const Scan& scan) {
  std::vector<float> ranges;
  for (size_t i = 0; i < scan.size(); ++i)
    ranges.push_back((scan.points[i] - scan.sensors[scan.sensor[i]].position.cast<float>()).norm());
  return ranges.empty() ? 0 : medianOf(std::move(ranges));
}

std::string degrees(double radians) {
  return std::to_string(std::lround(radians * 180.0 / M_PI));
}

/** Options in effect: keyed input is taken as it is. */
FrontEndOptions inEffect(FrontEndOptions options) {
  if (options.keyed) {
    options.scan.min_range_m = 0;
    options.scan.max_range_m = std::numeric_limits<double>::infinity();
    options.scan.body_box.clear();
  }
  return options;
}

std::unique_ptr<ScanAssembler> makeAssembler(const FrontEndOptions& options) {
  if (options.keyed) return std::make_unique<SameStampScans>();
  return std::make_unique<ReferenceLidarScans>(options.merge_window_s, options.scan);
}

}  // namespace

void FrontEndOptions::visit(OptionVisitor& v) {
  v("keyed", keyed,
    "the recordings already hold key nodes: clouds with the same stamp form one keyed scan, which "
    "is not filtered again");
  v("key_node_distance_m", key_node_distance_m, "m",
    "distance travelled before a new key node is added; smaller values give more loop closures and "
    "take more time; for robots in the plane at most a tenth of the median range, or 0.5 m",
    kPositive);
  v("key_node_angle_deg", key_node_angle_deg, "deg",
    "rotation before a new key node is added; for robots in the plane at most 15", kPositive);
  v("merge_window_s", merge_window_s, "s",
    "maximum age of the other lidars' scans that are merged into a keyed scan", kNotNegative);
  scan.visit(v);
  voxel.visit(v);
  motion.visit(v);
  gravity.visit(v);
}

FrontEnd::FrontEnd(RobotId robot, const FrontEndOptions& options,
                   std::vector<std::shared_ptr<OdometrySource>> odometry,
                   std::optional<StartPrior> prior)
    : robot_(robot),
      options_(inEffect(options)),
      odometry_(
          std::make_unique<OdometryChain>(std::move(odometry), options.keyed, options.motion)),
      prior_(std::move(prior)),
      assembler_(makeAssembler(options)),
      merger_(std::make_unique<ScanMerger>(options_.scan)),
      voxel_filter_(options.voxel),
      standstill_(std::make_unique<StandstillCheck>(options.keyed ? 0 : kStandstillLookS)),
      aperture_(std::make_unique<ApertureCheck>()),
      extras_(options.gravity),
      passed_scans_(std::make_unique<PassedScans>()) {}

FrontEnd::~FrontEnd() = default;

std::vector<KeyNodePacket> FrontEnd::observe(const InputObservation& observation) {
  odometry_->observe(observation);
  extras_.observe(observation);
  for (ScanParts& scan : assembler_->observe(observation)) enqueue(std::move(scan));
  return processCoveredScans();
}

std::vector<KeyNodePacket> FrontEnd::advanceTo(double stamp) {
  if (auto scan = assembler_->advanceTo(stamp)) enqueue(std::move(*scan));
  return processCoveredScans();
}

void FrontEnd::enqueue(ScanParts scan) {
  ++counts_.scans;
  if (waiting_.size() == kMaxWaitingScans) {
    dropWithoutOdometry(waiting_.front().stamp);
    waiting_.pop_front();
  }
  waiting_.push_back(std::move(scan));
}

std::vector<KeyNodePacket> FrontEnd::processCoveredScans() {
  std::vector<KeyNodePacket> packets;
  while (!waiting_.empty() && odometry_->ready(waiting_.front().stamp + merger_->sweep())) {
    if (auto packet = processScan(waiting_.front())) packets.push_back(std::move(*packet));
    waiting_.pop_front();
  }
  return packets;
}

std::vector<KeyNodePacket> FrontEnd::finish() {
  if (auto scan = assembler_->finish()) enqueue(std::move(*scan));
  odometry_->finish();
  std::vector<KeyNodePacket> packets;
  for (const ScanParts& parts : waiting_) {
    if (!odometry_->tracks() && !odometry_->covers(parts.stamp - kMaxExtrapolationS))
      dropWithoutOdometry(parts.stamp);
    else if (auto packet = processScan(parts))
      packets.push_back(std::move(*packet));
  }
  waiting_.clear();
  extras_.advanceTo(std::numeric_limits<double>::infinity(), odometry_->main());
  return packets;
}

RobotEnd FrontEnd::end() {
  return {robot_, passed_scans_->take(), last_key_ ? takeExtras(last_key_->pose) : KeyNodeExtras()};
}

std::optional<KeyNodePacket> FrontEnd::processScan(const ScanParts& parts) {
  for (const InputObservation& part : parts.observations) {
    planar_lidar_ = planar_lidar_ && isPlanarLaser(*part.observation);
    checkTilt(part);
  }
  checkAperture(parts);
  if (odometry_->tracks()) {
    Scan scan = filtered(merged(parts));
    const Pose3 odom_T_base = track(parts.stamp, scan);
    extras_.advanceTo(parts.stamp, odometry_->main());
    return processPose(parts, odom_T_base, std::move(scan));
  }
  extras_.advanceTo(parts.stamp, odometry_->main());
  const Pose3 odom_T_base = odometryPose(parts.stamp);
  const bool is_placed = placed(parts, odom_T_base);
  last_stamp_ = parts.stamp;
  if (!is_placed) return std::nullopt;
  return processPose(parts, odom_T_base, std::nullopt);
}

/** \param scan filtered, if that was done already. */
std::optional<KeyNodePacket> FrontEnd::processPose(const ScanParts& parts, const Pose3& odom_T_base,
                                                   std::optional<Scan> scan) {
  if (last_scan_pose_) path_since_key_.add(last_scan_pose_->inverse() * odom_T_base);
  last_scan_pose_ = odom_T_base;
  if (isKeyNode(odom_T_base)) {
    if (!scan) scan = filtered(merged(parts));
    scan->time.clear();
    if (!scan->points.empty()) return makePacket(parts.stamp, odom_T_base, std::move(*scan));
    ++counts_.empty_scans;
  }
  passed_scans_->add({parts.stamp, odom_T_base});
  return std::nullopt;
}

Pose3 FrontEnd::track(double stamp, Scan& scan) {
  ++counts_.tracked_scans;
  FilteredScan tracked;
  tracked.points = std::move(scan.points);
  tracked.time = std::exchange(scan.time, {});
  if (const double sweep = merger_->sweep(); sweep > 0)
    tracked.twist = logSE3(odometry_->motion(stamp, stamp + sweep)) / sweep;
  if (!scan.sensors.empty()) tracked.origin = scan.sensors.front().position.cast<float>();
  tracked.planar = planar();
  const Pose3 odom_T_base = odometry_->track(stamp, tracked);
  scan.points = std::move(tracked.points);
  return odom_T_base;
}

bool FrontEnd::planar() const {
  return planar_lidar_ && odometry_->planar();
}

void FrontEnd::checkTilt(const InputObservation& part) {
  using mrpt::obs::CObservation2DRangeScan;
  if (dynamic_cast<const CObservation2DRangeScan*>(part.observation.get()) &&
      !isPlanarLaser(*part.observation))
    tilted_lasers_.emplace(part.label, laserTilt(*part.observation));
}

/** By recorded odometry: what is made of bent scans fits them. */
void FrontEnd::checkAperture(const ScanParts& parts) {
  using mrpt::obs::CObservation2DRangeScan;
  const auto laser =
      std::dynamic_pointer_cast<CObservation2DRangeScan>(parts.observations.front().observation);
  const auto odom_T_base = odometry_->recordedPose(parts.stamp);
  if (!laser || !odom_T_base) return;
  const double stated = options_.scan.laser_aperture_deg * M_PI / 180.0;
  aperture_->observe(*laser, stated > 0 ? stated : laser->aperture, *odom_T_base);
}

/** Whether odometry knows where a scan was taken. */
bool FrontEnd::placed(const ScanParts& parts, const Pose3& odom_T_base) {
  if (!odometry_->knows(parts.stamp)) {
    dropWithoutOdometry(parts.stamp);
    leaveOut(last_stamp_, parts.stamp, kGapMPerS, kGapRadPerS);
    return false;
  }
  const bool contradicted =
      standstill_->contradicts(parts.stamp, odom_T_base, [&] { return merged(parts); });
  if (!contradicted) return true;
  ++counts_.contradicted;
  double begin = last_stamp_;
  if (const size_t dropped = passed_scans_->dropFrom(standstill_->begin()); dropped > 0) {
    counts_.contradicted += dropped;
    begin = standstill_->begin();
  }
  leaveOut(begin, parts.stamp, standstill_->speed(), kFailedRadPerS);
  return false;
}

void FrontEnd::dropWithoutOdometry(double stamp) {
  if (counts_.without_odometry++ == 0) first_without_odometry_ = stamp;
}

/** Nobody knows how the robot moved between two stamps. */
void FrontEnd::leaveOut(double begin, double end, double sigma_m_per_s, double sigma_rad_per_s) {
  extras_.take(Pose3::Identity());  // carried to here by what is wrong
  if (!last_key_) return;
  unmeasured_.sigma_m += sigma_m_per_s * (end - begin);
  unmeasured_.sigma_rad += sigma_rad_per_s * (end - begin);
}

/** Of a robot in the plane without what rounding, or a height of the odometry's frame, adds. */
Pose3 FrontEnd::odometryPose(double stamp) {
  const Pose3 pose = odometry_->poseAt(stamp);
  if (!first_pose_) first_pose_ = pose;
  return planar() ? Pose3(*first_pose_ * projectToPlane(first_pose_->inverse() * pose)) : pose;
}

/** Paper II-B: a new key node when the robot has moved or turned enough. */
bool FrontEnd::isKeyNode(const Pose3& odom_T_base) const {
  if (!last_key_ || options_.keyed || unmeasured_.sigma_m > 0) return true;
  const Pose3 motion = last_key_->pose.inverse() * odom_T_base;
  double distance_m = options_.key_node_distance_m, angle_deg = options_.key_node_angle_deg;
  if (planar()) {
    const double least = std::max(kPlanarDistanceM, kPlanarDistanceShare * median_range_m_);
    distance_m = std::min(distance_m, least);
    angle_deg = std::min(angle_deg, kPlanarAngleDeg);
  }
  return motion.translation().norm() >= distance_m ||
         rotationAngle(motion) * 180.0 / M_PI >= angle_deg;
}

/** All parts in the base frame at the scan's stamp. */
Scan FrontEnd::merged(const ScanParts& parts) {
  return merger_->merge(parts, [&](double from, double to) { return odometry_->motion(from, to); });
}

/** Unless that was done already, and unless the few points of a laser in the plane are all needed.
 */
Scan FrontEnd::filtered(Scan scan) {
  if (options_.keyed) return scan;
  if (!planar()) return voxel_filter_.filter(scan);
  median_range_m_ = medianRange(scan);
  const bool few = scan.size() <= static_cast<size_t>(options_.voxel.target_points);
  return few ? scan : voxel_filter_.filter(scan);
}

/** An inertial unit that contradicts the start pose is mounted otherwise than the recording says.
 */
bool FrontEnd::believes(const GravityReading& gravity, const Pose3& odom_T_base) {
  if (gravity_believed_) return *gravity_believed_;
  const Pose3 world_T_base = world_T_odom_ ? *world_T_odom_ * odom_T_base : odom_T_base;
  const Eigen::Vector3d up = world_T_base.linear() * gravity.base_up;
  gravity_deviation_ = std::acos(std::clamp(up.z(), -1.0, 1.0));
  double most = kFrameTiltRad;
  if (prior_)
    most = std::max(kStartTiltRad,
                    3.0 * std::sqrt(prior_->covariance.diagonal().segment<2>(3).maxCoeff()));
  gravity_believed_ = gravity_deviation_ <= most;
  return *gravity_believed_;
}

KeyNodeExtras FrontEnd::takeExtras(const Pose3& odom_T_base) {
  KeyNodeExtras extras = extras_.take(odom_T_base);
  if (extras.gravity && !believes(*extras.gravity, odom_T_base)) extras.gravity.reset();
  return extras;
}

KeyNodePacket FrontEnd::makePacket(double stamp, const Pose3& odom_T_base, Scan scan) {
  KeyNodePacket packet;
  packet.id = {robot_, static_cast<uint32_t>(counts_.key_nodes++)};
  packet.stamp = stamp;
  packet.odom_T_base = odom_T_base;
  packet.planar = planar();
  packet.scan = std::make_shared<const Scan>(std::move(scan));
  packet.passed_scans = passed_scans_->take();
  if (!last_key_ && prior_) world_T_odom_ = prior_->world_T_base * odom_T_base.inverse();
  packet.extras = takeExtras(odom_T_base);
  if (last_key_)
    packet.odometry = {last_key_->pose.inverse() * odom_T_base, motionCovariance(stamp)};
  else
    packet.prior = prior_;
  last_key_ = StampedPose{stamp, odom_T_base};
  odometry_->keepFrom(stamp);
  path_since_key_ = {};
  unmeasured_ = {};
  return packet;
}

Matrix6d FrontEnd::motionCovariance(double stamp) {
  Matrix6d covariance = odometry_->doubtBetween(last_key_->stamp, stamp);
  covariance.diagonal().head<3>().array() += std::pow(unmeasured_.sigma_m, 2);
  covariance.diagonal().tail<3>().array() += std::pow(std::min(M_PI, unmeasured_.sigma_rad), 2);
  const auto recorded = odometry_->covarianceBetween(last_key_->stamp, stamp);
  return covariance + (recorded ? *recorded : odometryCovariance(path_since_key_, options_.motion));
}

std::vector<std::string> FrontEnd::warnings() const {
  std::vector<std::string> result = odometry_->warnings();
  for (std::string& warning : assembler_->warnings()) result.push_back(std::move(warning));
  if (counts_.without_odometry > 0)
    result.push_back(std::to_string(counts_.without_odometry) + " of " +
                     std::to_string(counts_.scans) +
                     " scans were dropped: no odometry covers them, the first of them at " +
                     formatFixed(first_without_odometry_, 3) +
                     "; it begins later, ends earlier, or has gaps in which the robot moved");
  if (counts_.contradicted > 0)
    result.push_back(std::to_string(counts_.contradicted) +
                     " scans were dropped: they show motion while odometry says that the robot "
                     "stands; look for an encoder or a driver that failed");
  if (const auto seen = aperture_->contradiction())
    result.push_back("the 2D laser's field of view is taken to be " + degrees(aperture_->used()) +
                     " deg, but its scans turn against odometry as if it were about " +
                     degrees(*seen) + " deg: every scan is bent; set [frontend] " +
                     "laser_aperture_deg to what the laser has");
  for (const auto& [label, tilt] : tilted_lasers_)
    result.push_back("the 2D laser '" + label + "' is tilted by " + degrees(tilt) +
                     " deg: the robot is mapped in space, of which its scans show a slanted line "
                     "only; if it lies level, correct its sensorPose");
  if (gravity_believed_ && !*gravity_believed_)
    result.push_back("the inertial unit is not used: what it says is up lies " +
                     degrees(gravity_deviation_) + " deg from that of " +
                     (prior_ ? "the start pose" : "the odometry's frame") +
                     "; check how the recording says it is mounted (sensorPose)");
  if (merger_->unreadable() > 0)
    result.push_back(std::to_string(merger_->unreadable()) +
                     " scans could not be read, the first: " + merger_->firstUnreadable());
  if (counts_.empty_scans > 0)
    result.push_back(std::to_string(counts_.empty_scans) +
                     " scans had no usable point and could not become key nodes");
  return result;
}

}  // namespace lamp
