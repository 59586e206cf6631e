#include "lamp/frontend/SweepGatherer.h"

#include <cmath>
#include <utility>

namespace lamp {

namespace {

/** Poses that differ by less are those of a lidar at rest. */
constexpr double kRestRad = 1e-4;
/** This share of an observation's azimuths is new as long as its lidar goes on around. */
constexpr double kNewShare = 0.25;

}  // namespace

bool SweepGatherer::begins(double stamp, const Pose3& base_T_sensor, const Scan& points) {
  const Pose3 sensor_T_base = base_T_sensor.inverse();
  Azimuths seen;
  for (const Eigen::Vector3f& point : points.points) {
    const Eigen::Vector3d p = sensor_T_base * point.cast<double>();
    const double turn = std::atan2(p.y(), p.x()) / (2.0 * M_PI) + 0.5;
    seen.set(std::min<size_t>(static_cast<size_t>(turn * kAzimuths), kAzimuths - 1));
  }
  const bool first = observations_ == 0;
  const bool begins =
      hasComeRound(base_T_sensor, seen) || first || stamp - begin_ >= longest_s_ || wholeScans();
  last_pose_ = base_T_sensor;
  if (begins) {
    if (!first) noteScan();
    begin_ = stamp;
    observations_ = 0;
    turned_rad_ = 0;
    seen_.reset();
  }
  seen_ |= seen;
  ++observations_;
  return begins;
}

/** Counts on how far the mount has turned. */
bool SweepGatherer::hasComeRound(const Pose3& base_T_sensor, const Azimuths& seen) {
  if (!last_pose_) return false;
  const Eigen::AngleAxisd step((base_T_sensor * last_pose_->inverse()).linear());
  if (step.angle() > kRestRad) {
    const Eigen::Vector3d before = std::exchange(axis_, step.axis());
    turned_rad_ += step.angle();
    return before.dot(axis_) < 0 || turned_rad_ >= M_PI;
  }
  if (!axis_.isZero() || seen.none()) return false;
  const double old = static_cast<double>((seen & seen_).count());
  return old > (1.0 - kNewShare) * static_cast<double>(seen.count());
}

void SweepGatherer::noteScan() {
  single_scans_ = wholeScans() || observations_ == 1 ? single_scans_ + 1 : 0;
}

}  // namespace lamp
