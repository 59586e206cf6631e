#include "OdometryContinuity.h"

#include <algorithm>
#include <cmath>

namespace lamp {

namespace {

constexpr double kDegree = M_PI / 180.0;

/** Steps are judged by so many before them, and not before there are a few. */
constexpr size_t kMostSteps = 20, kFewestSteps = 5;
/** An ordinary step is no longer than this many of the longest of those, */
constexpr double kLonger = 3.0;
/** plus this, */
constexpr double kStepM = 0.3, kStepRad = 15.0 * kDegree;
/** plus what a robot that was at rest may do in that time. */
constexpr double kSpeedM = 2.0, kSpeedRad = 60.0 * kDegree;

/** Poses that are the same are the same to this. */
constexpr double kSameM = 1e-6, kSameRad = 1e-6;
/** A robot that is so near its start may be there by its own motion. */
constexpr double kNearM = 0.1, kNearRad = 3.0 * kDegree;

/** The motion over a restart is known for no longer than this; its error, at rest or not. */
constexpr double kPredictableS = 1.0;
constexpr double kRestartM = 0.05, kRestartRad = 1.0 * kDegree;
constexpr double kLeastSpeedM = 0.5, kLeastSpeedRad = 10.0 * kDegree;

}  // namespace

std::vector<OdometryReading> OdometryContinuity::take(const OdometryReading& reading) {
  if (!first_) {
    first_ = reading;
    return {accept(reading)};
  }
  if (!doubtful_) {
    if (ordinary(between(*last_, reading)) && !returnsToStart(reading)) return {accept(reading)};
    doubtful_ = reading;
    return {};
  }
  const OdometryReading before = *doubtful_;
  const bool follows = ordinary(between(before, reading));
  if (!follows) {
    ++astray_;
    doubtful_.reset();
    return take(reading);
  }
  doubtful_.reset();
  restartAt(before);
  return {accept(before), accept(reading)};
}

OdometryContinuity::Step OdometryContinuity::between(const OdometryReading& from,
                                                     const OdometryReading& to) {
  const Pose3 motion = from.odom_T_base.inverse() * to.odom_T_base;
  return {to.stamp - from.stamp, motion.translation().norm(), rotationAngle(motion)};
}

bool OdometryContinuity::ordinary(const Step& step) const {
  if (steps_.size() < kFewestSteps) return true;
  double longest = 0, widest = 0;
  for (const Step& s : steps_) {
    longest = std::max(longest, s.length_m);
    widest = std::max(widest, s.angle_rad);
  }
  return step.length_m <= kLonger * longest + kStepM + kSpeedM * step.seconds &&
         step.angle_rad <= kLonger * widest + kStepRad + kSpeedRad * step.seconds;
}

bool OdometryContinuity::returnsToStart(const OdometryReading& reading) const {
  const auto isAt = [&](const Pose3& start) {
    const Pose3 motion = start.inverse() * reading.odom_T_base;
    return motion.translation().norm() < kSameM && rotationAngle(motion) < kSameRad;
  };
  const Step away = between(*last_, reading);
  return (away.length_m > kNearM || away.angle_rad > kNearRad) &&
         (isAt(first_->odom_T_base) || isAt(Pose3::Identity()));
}

OdometryReading OdometryContinuity::accept(const OdometryReading& reading) {
  if (last_ && !restarted_) {
    steps_.push_back(between(*last_, reading));
    if (steps_.size() > kMostSteps) steps_.pop_front();
    last_motion_ = last_->odom_T_base.inverse() * reading.odom_T_base;
  }
  restarted_ = false;
  last_ = reading;
  OdometryReading continued = reading;
  continued.odom_T_base = odom_T_recorded_ * reading.odom_T_base;
  return continued;
}

/** \param reading the first one after the restart. */
void OdometryContinuity::restartAt(const OdometryReading& reading) {
  const double seconds = reading.stamp - last_->stamp;
  double speed = kLeastSpeedM, rate = kLeastSpeedRad;
  for (const Step& step : steps_) {
    speed = std::max(speed, step.length_m / step.seconds);
    rate = std::max(rate, step.angle_rad / step.seconds);
  }
  restarts_.push_back({last_->stamp, reading.stamp, kRestartM + speed * seconds,
                       std::min(M_PI, kRestartRad + rate * seconds)});
  odom_T_recorded_ =
      odom_T_recorded_ * last_->odom_T_base * likelyMotion(seconds) * reading.odom_T_base.inverse();
  restarted_ = true;
}

Pose3 OdometryContinuity::likelyMotion(double seconds) const {
  if (steps_.empty() || seconds > kPredictableS) return Pose3::Identity();
  return interpolate(Pose3::Identity(), last_motion_, seconds / steps_.back().seconds);
}

}  // namespace lamp
