#include "ApertureCheck.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lamp {

namespace {

constexpr double kDegree = M_PI / 180.0;

/** Scans are compared if the robot has turned this much between them, and hardly moved. */
constexpr double kLeastTurnRad = 4.0 * kDegree, kMostTurnRad = 25.0 * kDegree;
constexpr double kMostMotionM = 0.1;
/** Mean difference of the ranges at the best shift, metres, and as a share of that without one. */
constexpr double kMaxDifferenceM = 0.15, kMaxShare = 0.5;
/** What a single range may add: something else may have moved. */
constexpr float kDifferenceLimitM = 1.0f;
/** So much turning tells; wheel odometry is not better than this. */
constexpr double kEnoughRad = 90.0 * kDegree, kMaxRatio = 1.3;

std::vector<float> rangesOf(const mrpt::obs::CObservation2DRangeScan& scan) {
  std::vector<float> ranges(scan.getScanSize(), 0.0f);
  for (size_t i = 0; i < ranges.size(); ++i)
    if (scan.getScanRangeValidity(i) && scan.getScanRange(i) < scan.maxRange)
      ranges[i] = scan.getScanRange(i);
  return ranges;
}

/** Mean difference of two scans, one shifted by so many beams; infinite if they hardly overlap. */
double difference(const std::vector<float>& a, const std::vector<float>& b, int shift) {
  double sum = 0;
  size_t count = 0;
  const int size = static_cast<int>(a.size());
  for (int i = std::max(0, -shift); i < size - std::max(0, shift); ++i) {
    const float before = a[static_cast<size_t>(i)], now = b[static_cast<size_t>(i + shift)];
    if (!(before > 0 && now > 0)) continue;
    sum += std::min(kDifferenceLimitM, std::abs(before - now));
    ++count;
  }
  return 3 * count < a.size() ? HUGE_VAL : sum / static_cast<double>(count);
}

/** Beams by which the second scan is shifted; zero if that cannot be told. */
int shiftBetween(const std::vector<float>& a, const std::vector<float>& b) {
  const int most = static_cast<int>(a.size()) / 2;
  int best = 0;
  double least = HUGE_VAL;
  for (int shift = -most; shift <= most; ++shift) {
    const double d = difference(a, b, shift);
    if (d < least) least = d, best = shift;
  }
  return least < kMaxDifferenceM && least < kMaxShare * difference(a, b, 0) ? best : 0;
}

}  // namespace

void ApertureCheck::observe(const mrpt::obs::CObservation2DRangeScan& scan, double aperture_rad,
                            const Pose3& odom_T_base) {
  aperture_rad_ = aperture_rad;
  if (decided()) return;
  const Pose3 motion =
      reference_ ? Pose3(reference_->odom_T_base.inverse() * odom_T_base) : Pose3::Identity();
  const double turn = std::abs(yawOf(motion));
  const bool comparable = reference_ && reference_->ranges.size() == scan.getScanSize() &&
                          motion.translation().norm() <= kMostMotionM && turn <= kMostTurnRad;
  if (comparable && turn < kLeastTurnRad) return;
  View now{rangesOf(scan), odom_T_base};
  if (comparable) {
    const int shift = std::abs(shiftBetween(reference_->ranges, now.ranges));
    if (shift > 0) turned_rad_ += turn;
    shifted_beams_ += shift;
    beams_ = now.ranges.size();
  }
  reference_ = std::move(now);
}

bool ApertureCheck::decided() const {
  return turned_rad_ > kEnoughRad;
}

std::optional<double> ApertureCheck::contradiction() const {
  if (!decided()) return std::nullopt;
  const double seen = turned_rad_ / shifted_beams_ * static_cast<double>(beams_ - 1);
  const double ratio = std::max(seen, aperture_rad_) / std::min(seen, aperture_rad_);
  return ratio > kMaxRatio ? std::optional<double>(seen) : std::nullopt;
}

}  // namespace lamp
