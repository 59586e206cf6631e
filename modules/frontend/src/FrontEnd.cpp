#include "lamp/frontend/FrontEnd.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace lamp {

namespace {

/** Scans wait for the odometry that follows them; if none comes, memory must not grow. */
constexpr size_t kMaxWaitingScans = 200;
/** Behind the last odometry reading a robot is taken to stand still, but not for longer. */
constexpr double kMaxExtrapolationS = 0.5;

void append(const Scan& scan, const Pose3& target_T_scan, Scan& target) {
  const auto first_sensor = static_cast<uint8_t>(target.sensors.size());
  for (SensorOrigin origin : scan.sensors) {
    origin.position = target_T_scan * origin.position;
    target.sensors.push_back(origin);
  }
  const bool keep_intensity =
      scan.hasIntensity() && (target.hasIntensity() || target.points.empty());
  const Eigen::Isometry3f T = target_T_scan.cast<float>();
  for (size_t i = 0; i < scan.size(); ++i) {
    target.points.push_back(T * scan.points[i]);
    target.sensor.push_back(static_cast<uint8_t>(first_sensor + scan.sensor[i]));
    if (keep_intensity)
      target.intensity.push_back(scan.intensity[i]);
    else if (target.hasIntensity())
      target.intensity.push_back(0.0f);
  }
}

/** Options in effect: keyed input is taken as it is. */
FrontEndOptions inEffect(FrontEndOptions options) {
  if (options.keyed) {
    options.scan.min_range_m = 0;
    options.scan.max_range_m = std::numeric_limits<double>::infinity();
  }
  return options;
}

std::unique_ptr<ScanAssembler> makeAssembler(const FrontEndOptions& options) {
  if (options.keyed) return std::make_unique<SameStampScans>();
  return std::make_unique<ReferenceLidarScans>(options.merge_window_s);
}

}  // namespace

void FrontEndOptions::visit(OptionVisitor& v) {
  v("keyed", keyed,
    "the recordings already hold key nodes: clouds with the same stamp form one keyed scan, which "
    "is not filtered again");
  v("key_node_distance_m", key_node_distance_m, "m",
    "distance travelled before a new key node is added; smaller values give more loop closures and "
    "take more time",
    kPositive);
  v("key_node_angle_deg", key_node_angle_deg, "deg", "rotation before a new key node is added",
    kPositive);
  v("merge_window_s", merge_window_s, "s",
    "maximum age of the other lidars' scans that are merged into a keyed scan", kNotNegative);
  scan.visit(v);
  voxel.visit(v);
  motion.visit(v);
  gravity.visit(v);
}

FrontEnd::FrontEnd(RobotId robot, const FrontEndOptions& options,
                   std::shared_ptr<OdometrySource> odometry, std::optional<StartPrior> prior)
    : robot_(robot),
      options_(inEffect(options)),
      odometry_(std::move(odometry)),
      prior_(std::move(prior)),
      assembler_(makeAssembler(options)),
      voxel_filter_(options.voxel),
      extras_(options.gravity) {}

std::vector<KeyNodePacket> FrontEnd::observe(const InputObservation& observation) {
  odometry_->observe(observation);
  extras_.observe(observation);
  if (auto scan = assembler_->observe(observation)) enqueue(std::move(*scan));
  return processCoveredScans();
}

std::vector<KeyNodePacket> FrontEnd::advanceTo(double stamp) {
  if (auto scan = assembler_->advanceTo(stamp)) enqueue(std::move(*scan));
  return processCoveredScans();
}

void FrontEnd::enqueue(ScanParts scan) {
  ++counts_.scans;
  if (waiting_.size() == kMaxWaitingScans) {
    waiting_.pop_front();
    ++counts_.without_odometry;
  }
  waiting_.push_back(std::move(scan));
}

std::vector<KeyNodePacket> FrontEnd::processCoveredScans() {
  std::vector<KeyNodePacket> packets;
  while (!waiting_.empty() && odometry_->covers(waiting_.front().stamp)) {
    if (auto packet = processScan(waiting_.front())) packets.push_back(std::move(*packet));
    waiting_.pop_front();
  }
  return packets;
}

std::vector<KeyNodePacket> FrontEnd::finish() {
  if (auto scan = assembler_->finish()) enqueue(std::move(*scan));
  std::vector<KeyNodePacket> packets;
  for (const ScanParts& parts : waiting_) {
    if (!odometry_->covers(parts.stamp - kMaxExtrapolationS))
      ++counts_.without_odometry;
    else if (auto packet = processScan(parts))
      packets.push_back(std::move(*packet));
  }
  waiting_.clear();
  extras_.advanceTo(std::numeric_limits<double>::infinity(), *odometry_);
  return packets;
}

RobotEnd FrontEnd::end() {
  return {robot_, std::move(passed_scans_),
          last_key_ ? extras_.take(last_key_->pose) : KeyNodeExtras()};
}

std::optional<KeyNodePacket> FrontEnd::processScan(const ScanParts& parts) {
  extras_.advanceTo(parts.stamp, *odometry_);
  const Pose3 odom_T_base = odometry_->poseAt(parts.stamp);
  if (last_scan_pose_) path_since_key_.add(last_scan_pose_->inverse() * odom_T_base);
  last_scan_pose_ = odom_T_base;

  if (isKeyNode(odom_T_base)) {
    Scan scan = keyedScan(parts, odom_T_base);
    if (!scan.points.empty()) return makePacket(parts.stamp, odom_T_base, std::move(scan));
    ++counts_.empty_scans;
  }
  passed_scans_.push_back({parts.stamp, odom_T_base});
  return std::nullopt;
}

/** Paper II-B: a new key node when the robot has moved or turned enough. */
bool FrontEnd::isKeyNode(const Pose3& odom_T_base) const {
  if (!last_key_ || options_.keyed) return true;
  const Pose3 motion = last_key_->pose.inverse() * odom_T_base;
  return motion.translation().norm() >= options_.key_node_distance_m ||
         rotationAngle(motion) * 180.0 / M_PI >= options_.key_node_angle_deg;
}

/** All parts in the base frame at the scan's stamp, filtered unless they were already. */
Scan FrontEnd::keyedScan(const ScanParts& parts, const Pose3& odom_T_base) {
  Scan merged;
  for (const InputObservation& part : parts.observations) {
    const bool same_time = part.stamp == parts.stamp;
    appendScan(part,
               same_time ? Pose3::Identity()
                         : Pose3(odom_T_base.inverse() * odometry_->poseAt(part.stamp)),
               merged);
  }
  return options_.keyed ? merged : voxel_filter_.filter(merged);
}

void FrontEnd::appendScan(const InputObservation& observation, const Pose3& base_T_scan,
                          Scan& merged) {
  planar_lidar_ = planar_lidar_ && isPlanarLaser(*observation.observation);
  try {
    const auto scan =
        scanFromObservation(*observation.observation, observation.label, options_.scan);
    if (scan) append(*scan, base_T_scan, merged);
  } catch (const std::exception& error) {  // MRPT throws logic errors for missing files
    if (counts_.unreadable_scans++ == 0) first_unreadable_ = error.what();
  }
}

KeyNodePacket FrontEnd::makePacket(double stamp, const Pose3& odom_T_base, Scan scan) {
  KeyNodePacket packet;
  packet.id = {robot_, static_cast<uint32_t>(counts_.key_nodes++)};
  packet.stamp = stamp;
  packet.odom_T_base = odom_T_base;
  packet.planar = planar_lidar_ && odometry_->planar();
  packet.scan = std::make_shared<const Scan>(std::move(scan));
  packet.passed_scans = std::move(passed_scans_);
  passed_scans_.clear();
  packet.extras = extras_.take(odom_T_base);
  if (last_key_)
    packet.odometry = {last_key_->pose.inverse() * odom_T_base, motionCovariance(stamp)};
  else
    packet.prior = prior_;
  last_key_ = StampedPose{stamp, odom_T_base};
  path_since_key_ = {};
  return packet;
}

Matrix6d FrontEnd::motionCovariance(double stamp) {
  if (const auto recorded = odometry_->covarianceBetween(last_key_->stamp, stamp)) return *recorded;
  return odometryCovariance(path_since_key_, options_.motion);
}

std::vector<std::string> FrontEnd::warnings() const {
  std::vector<std::string> result = odometry_->warnings();
  for (std::string& warning : assembler_->warnings()) result.push_back(std::move(warning));
  if (counts_.without_odometry > 0)
    result.push_back(std::to_string(counts_.without_odometry) + " of " +
                     std::to_string(counts_.scans) +
                     " scans were dropped: no odometry covers them");
  if (counts_.unreadable_scans > 0)
    result.push_back(std::to_string(counts_.unreadable_scans) +
                     " scans could not be read, the first: " + first_unreadable_);
  if (counts_.empty_scans > 0)
    result.push_back(std::to_string(counts_.empty_scans) +
                     " scans had no usable point and could not become key nodes");
  return result;
}

}  // namespace lamp
