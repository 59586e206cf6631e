#include "GyroRotation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "lamp/core/Csv.h"
#include "lamp/input/ExtrasFromObservation.h"

namespace lamp {

namespace {

/** Readings are kept this long, and none is missing if they lie no farther apart than this. */
constexpr double kKeptS = 60.0, kMaxGapS = 0.1;
/** Of an inexpensive unit: how its bias wanders, rad/s per sqrt(s); angle random walk, rad per
 * sqrt(s); scale and mounting, as a part of the rotation. */
constexpr double kBiasWalk = 1e-4, kWalk = 5e-4, kScale = 0.01;
/** The lidar contradicts what lies so many standard deviations off, and no less than this. */
constexpr double kContradiction = 4.0, kContradictionRad = 0.01;
/** Rotations of so many standard deviations tell; after so many, of which so many contradict, the
 * unit is given up. */
constexpr double kTelling = 4.0;
constexpr size_t kComparisons = 10, kContradictions = 5;
/** Between scans less far apart the lidar's noise would pass for bias. */
constexpr double kBaselineS = 2.0;

Eigen::Vector3d logOf(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

Eigen::Matrix3d rotationBy(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  if (!(angle > 0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, v / angle).toRotationMatrix();
}

}  // namespace

bool contradict(const MeasuredRotation& a, const MeasuredRotation& b) {
  return logOf(a.rotation.transpose() * b.rotation).norm() >
         std::max(kContradictionRad, kContradiction * std::hypot(a.sigma_rad, b.sigma_rad));
}

void GyroRotation::observe(const InputObservation& observation) {
  if (given_up_) return;
  const auto reading = inertialFromObservation(observation);
  if (!reading) return;
  if (!label_) label_ = observation.label;
  if (observation.label != *label_) return;
  if (!readings_.empty() && observation.stamp <= readings_.back().stamp) return;
  readings_.push_back({observation.stamp, reading->angular_velocity});
  while (readings_.front().stamp < observation.stamp - kKeptS) readings_.pop_front();
}

bool GyroRotation::covers(double stamp) const {
  return given_up_ || readings_.empty() || readings_.back().stamp >= stamp;
}

std::optional<MeasuredRotation> GyroRotation::between(double from, double to) const {
  if (given_up_) return std::nullopt;
  if (from <= to) return integrated(from, to);
  auto back = integrated(to, from);
  if (back) back->rotation.transposeInPlace();
  return back;
}

/** Rates between readings are interpolated, beyond the ends held. */
std::optional<MeasuredRotation> GyroRotation::integrated(double from, double to) const {
  if (readings_.empty() || from < readings_.front().stamp - kMaxGapS ||
      to > readings_.back().stamp + kMaxGapS)
    return std::nullopt;
  auto next = std::upper_bound(readings_.begin(), readings_.end(), from,
                               [](double t, const Reading& r) { return t < r.stamp; });
  const auto rateAt = [&](double stamp, std::deque<Reading>::const_iterator after) {
    if (after == readings_.begin()) return after->rate;
    if (after == readings_.end()) return readings_.back().rate;
    const Reading& before = *(after - 1);
    const double ratio = (stamp - before.stamp) / (after->stamp - before.stamp);
    return Eigen::Vector3d(before.rate + ratio * (after->rate - before.rate));
  };
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double stamp = from;
  Eigen::Vector3d rate = rateAt(from, next);
  while (stamp < to) {
    if (next != readings_.end() && next != readings_.begin() &&
        next->stamp - (next - 1)->stamp > kMaxGapS)
      return std::nullopt;
    const double end = next == readings_.end() ? to : std::min(to, next->stamp);
    const Eigen::Vector3d rate_then = rateAt(end, next);
    rotation *= rotationBy((0.5 * (rate + rate_then) - bias_) * (end - stamp));
    stamp = end;
    rate = rate_then;
    if (next != readings_.end()) ++next;
  }
  const double seconds = to - from;
  const double turned = std::abs(Eigen::AngleAxisd(rotation).angle());
  return MeasuredRotation{rotation,
                          std::sqrt(bias_variance_ * seconds * seconds + kWalk * kWalk * seconds +
                                    std::pow(kScale * turned, 2))};
}

void GyroRotation::compare(double stamp, const MeasuredRotation& seen) {
  if (!compared_) compared_ = {stamp, seen};
  const double seconds = stamp - compared_->stamp;
  if (seconds < kBaselineS) return;
  const Seen from = *std::exchange(compared_, Seen{stamp, seen});
  const auto own = between(from.stamp, stamp);
  if (!own) return;
  const MeasuredRotation turn{from.orientation.rotation.transpose() * seen.rotation,
                              std::hypot(from.orientation.sigma_rad, seen.sigma_rad)};
  const bool contradicts = contradict(*own, turn);
  const double sigma = std::hypot(own->sigma_rad, turn.sigma_rad);
  if (std::max(logOf(turn.rotation).norm(), logOf(own->rotation).norm()) > kTelling * sigma)
    noteContradiction(contradicts, stamp);
  bias_variance_ += kBiasWalk * kBiasWalk * seconds;
  if (contradicts) return;
  // A Kalman filter, the same for all three axes.
  const double other = sigma * sigma / (seconds * seconds) - bias_variance_;
  const double gain = bias_variance_ / (bias_variance_ + std::max(0.0, other));
  bias_ += gain * logOf(turn.rotation.transpose() * own->rotation) / seconds;
  bias_variance_ *= 1 - gain;
}

void GyroRotation::noteContradiction(bool contradicts, double stamp) {
  contradicted_.push_back(contradicts);
  if (contradicted_.size() > kComparisons) contradicted_.pop_front();
  const auto count = std::count(contradicted_.begin(), contradicted_.end(), true);
  if (static_cast<size_t>(count) >= kContradictions) given_up_ = stamp;
}

std::vector<std::string> GyroRotation::warnings() const {
  if (!given_up_) return {};
  return {"the gyros of '" + *label_ + "' are not used after " + formatFixed(*given_up_, 3) +
          ": again and again the lidar has seen another rotation; check how the recording says the "
          "unit is mounted (sensorPose), and its clock"};
}

}  // namespace lamp
