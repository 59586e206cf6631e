#include "lamp/frontend/RecordedOdometry.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "OdometryContinuity.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Median.h"
#include "lamp/frontend/LidarOdometry.h"

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(OdometrySource, Stage, lamp)
IMPLEMENTS_MRPT_OBJECT(RecordedOdometry, lamp::OdometrySource, lamp)

namespace lamp {

namespace {

constexpr double kDegree = M_PI / 180.0;

/** Readings that lie this much farther apart than the median of the last ones, and farther than the
 * least time, leave a gap. */
constexpr size_t kIntervals = 20, kFewestIntervals = 5;
constexpr double kGapFactor = 5.0, kLeastGapS = 1.0;
/** A robot that has moved less over a gap has stood. */
constexpr double kStoodM = 0.3, kStoodRad = 5.0 * kDegree;
/** So near to a reading, in time, its pose is good enough. */
constexpr double kNearS = 0.5;
/** Poses so long before the newest reading are not asked for any more. */
constexpr double kKeptS = 60.0;

/** A robot in the plane may seem to leave it by so much, and this share of its path. */
constexpr double kPlaneM = 0.1, kPlaneShare = 0.02, kPlaneRad = 3.0 * kDegree;

}  // namespace

RecordedOdometry::RecordedOdometry() : continuity_(std::make_shared<OdometryContinuity>()) {}

void RecordedOdometry::observe(const InputObservation& observation) {
  if (!isOdometry(*observation.observation)) return;
  const auto reading = odometryFromObservation(*observation.observation);
  if (!reading) {
    ++not_finite_;
    return;
  }
  if (newest_ && reading->stamp <= *newest_) {
    ++out_of_order_;
    return;
  }
  newest_ = reading->stamp;
  for (const OdometryReading& continued : continuity_->take(*reading)) add(continued);
}

void RecordedOdometry::add(const OdometryReading& reading) {
  if (!first_) first_ = reading;
  if (!readings_.empty()) noteGap(readings_.back(), reading);
  planar_ = planar_ && staysInPlane(reading);
  readings_.push_back(reading);
  while (readings_.size() > 2 && readings_[1].stamp <= reading.stamp - kKeptS)
    readings_.pop_front();
}

void RecordedOdometry::noteGap(const OdometryReading& before, const OdometryReading& after) {
  const double interval = after.stamp - before.stamp;
  const Pose3 motion = before.odom_T_base.inverse() * after.odom_T_base;
  path_m_ += motion.translation().norm();
  const bool gap = intervals_.size() >= kFewestIntervals &&
                   interval > std::max(kLeastGapS, kGapFactor * medianOf(intervals_));
  const bool moved = motion.translation().norm() > kStoodM || rotationAngle(motion) > kStoodRad;
  if (gap && moved) gaps_.push_back({before.stamp, after.stamp});
  if (gap) return;
  intervals_.push_back(interval);
  if (intervals_.size() > kIntervals) intervals_.pop_front();
}

bool RecordedOdometry::staysInPlane(const OdometryReading& reading) const {
  if (reading.planar) return true;
  const auto up = [](const Pose3& pose) -> Eigen::Vector3d { return pose.linear().col(2); };
  const Pose3 motion = first_->odom_T_base.inverse() * reading.odom_T_base;
  return std::abs(motion.translation().z()) <= kPlaneM + kPlaneShare * path_m_ &&
         up(motion).z() >= std::cos(kPlaneRad);
}

bool RecordedOdometry::covers(double stamp) const {
  return !readings_.empty() && readings_.back().stamp >= stamp;
}

bool RecordedOdometry::knows(double stamp) const {
  if (!first_ || stamp < first_->stamp - kNearS) return false;
  return std::none_of(gaps_.begin(), gaps_.end(), [&](const Gap& gap) {
    return stamp > gap.begin + kNearS && stamp < gap.end - kNearS;
  });
}

std::deque<OdometryReading>::const_iterator RecordedOdometry::atOrAfter(double stamp) const {
  const auto found =
      std::lower_bound(readings_.begin(), readings_.end(), stamp,
                       [](const OdometryReading& reading, double t) { return reading.stamp < t; });
  return found == readings_.end() ? readings_.end() - 1 : found;
}

Pose3 RecordedOdometry::poseAt(double stamp) {
  const auto after = atOrAfter(stamp);
  if (after == readings_.begin() || after->stamp < stamp) return after->odom_T_base;
  const auto before = after - 1;
  const Pose3 pose = interpolate(before->odom_T_base, after->odom_T_base,
                                 (stamp - before->stamp) / (after->stamp - before->stamp));
  return before->planar && after->planar ? projectToPlane(pose) : pose;
}

void RecordedOdometry::keepFrom(double stamp) {
  if (!readings_.empty()) kept_ = StampedReading{stamp, *atOrAfter(stamp)};
}

std::optional<Matrix6d> RecordedOdometry::covarianceBetween(double begin, double end) {
  if (!doubtBetween(begin, end).isZero()) return std::nullopt;
  const auto last = atOrAfter(end);
  const OdometryReading* const first =
      kept_ && kept_->stamp == begin ? &kept_->reading : &*atOrAfter(begin);
  std::optional<Matrix6d> result;
  if (first->covariance && last->covariance && first->stamp < last->stamp) {
    const Pose3 motion = first->odom_T_base.inverse() * last->odom_T_base;
    const Matrix6d growth =
        *last->covariance - composeCovariance(*first->covariance, motion, Matrix6d::Zero());
    const Matrix6d symmetric = 0.5 * (growth + growth.transpose());
    const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(symmetric, Eigen::EigenvaluesOnly);
    if (eigen.eigenvalues().minCoeff() > 0)
      result = symmetric;
    else
      ++ignored_covariances_;
  }
  return result;
}

Matrix6d RecordedOdometry::doubtBetween(double begin, double end) const {
  Matrix6d doubt = Matrix6d::Zero();
  for (const OdometryContinuity::Restart& restart : continuity_->restarts()) {
    if (restart.end <= begin || restart.begin >= end) continue;
    doubt.diagonal().head<3>().array() += restart.sigma_m * restart.sigma_m;
    doubt.diagonal().tail<3>().array() += restart.sigma_rad * restart.sigma_rad;
  }
  return doubt;
}

std::vector<std::string> RecordedOdometry::continuityWarnings() const {
  std::vector<std::string> result;
  if (!continuity_->restarts().empty())
    result.push_back("odometry begins anew " + std::to_string(continuity_->restarts().size()) +
                     " times, first at " + formatFixed(continuity_->restarts().front().end, 3) +
                     ": it is continued at the speed that the robot had, with a covariance that "
                     "says how little is known of that motion");
  if (continuity_->astray() > 0)
    result.push_back(std::to_string(continuity_->astray()) +
                     " odometry readings were dropped: they lie astray of those around them");
  return result;
}

std::vector<std::string> RecordedOdometry::warnings() const {
  std::vector<std::string> result = continuityWarnings();
  if (ignored_covariances_ > 0)
    result.push_back(
        "the recorded covariance of the odometry does not grow with the motion: it was ignored " +
        std::to_string(ignored_covariances_) +
        " times, and the motion model of [frontend] stands in");
  if (not_finite_ > 0)
    result.push_back(std::to_string(not_finite_) +
                     " odometry readings were dropped: their poses are not finite");
  if (out_of_order_ > 0)
    result.push_back(std::to_string(out_of_order_) +
                     " odometry readings were dropped: their stamps do not increase");
  return result;
}

void registerAllClasses_lamp_frontend() {
  mrpt::rtti::registerClass(CLASS_ID(OdometrySource));
  mrpt::rtti::registerClass(CLASS_ID(RecordedOdometry));
  mrpt::rtti::registerClass(CLASS_ID(ScanOdometry));
  mrpt::rtti::registerClass(CLASS_ID(LidarOdometry));
}

}  // namespace lamp
