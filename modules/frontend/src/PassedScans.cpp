#include "PassedScans.h"

#include <utility>

namespace lamp {

namespace {

/** So many scans of a standstill are kept. */
constexpr size_t kStanding = 100;
/** A robot that is within this of where the standstill began stands: odometry from the lidar
 * trembles. */
constexpr double kStandsM = 0.02, kStandsRad = 0.5 * M_PI / 180.0;

bool stands(const Pose3& from, const Pose3& to) {
  const Pose3 motion = from.inverse() * to;
  return motion.translation().norm() <= kStandsM && rotationAngle(motion) <= kStandsRad;
}

}  // namespace

void PassedScans::add(const StampedPose& scan) {
  if (standstill_ >= scans_.size() || !stands(scans_[standstill_].pose, scan.pose))
    standstill_ = scans_.size();
  if (scans_.size() > standstill_ + kStanding) scans_.pop_back();
  scans_.push_back(scan);
}

size_t PassedScans::dropFrom(double stamp) {
  size_t dropped = 0;
  for (; !scans_.empty() && scans_.back().stamp >= stamp; scans_.pop_back()) ++dropped;
  return dropped;
}

std::vector<StampedPose> PassedScans::take() {
  standstill_ = 0;
  return std::exchange(scans_, {});
}

}  // namespace lamp
