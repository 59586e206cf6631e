#include "ClockOffset.h"

#include <algorithm>
#include <cmath>

namespace lamp {

namespace {

/** Offsets that are tried. */
constexpr double kMostS = 2.0, kStepS = 0.05;
constexpr int kOffsets = 81;
constexpr int kNone = kOffsets / 2;
/** Before its first reading a source may hold the pose for so long. */
constexpr double kHeldS = 0.5;
/** Scans farther apart say little about the moment of a turn. */
constexpr double kLongestS = 0.5;
/** What turns more slowly says nothing, */
constexpr double kTurnsRadPerS = 0.1;
/** and less of it in all says too little. */
constexpr double kEnoughRad = 1.5;
/** The smallest sum has to be this many times smaller than the largest to mark a moment. */
constexpr double kSharp = 4.0;
/** Stamps are wrong if their sum is this many times the smallest, and not a lag that is usual. */
constexpr double kWorse = 1.2, kMattersS = 0.1;

double offsetOf(int k) {
  return (k - kNone) * kStepS;
}

}  // namespace

ClockOffset::ClockOffset() : squares_(kOffsets, 0.0) {}

void ClockOffset::observe(const StampedPose& previous, const StampedPose& scan,
                          OdometrySource& other) {
  const Step step{previous.stamp, scan.stamp, previous.pose.inverse() * scan.pose};
  const double seconds = step.end - step.begin;
  if (seconds <= kLongestS && rotationAngle(step.motion) > kTurnsRadPerS * seconds)
    waiting_.push_back(step);
  for (; !waiting_.empty() && scan.stamp - waiting_.front().end > kMostS; waiting_.pop_front())
    if (other.covers(waiting_.front().end + kMostS)) compare(waiting_.front(), other);
}

void ClockOffset::compare(const Step& step, OdometrySource& other) {
  for (const double stamp : {step.begin - kMostS - kHeldS, step.begin, step.end + kMostS})
    if (!other.knows(stamp)) return;
  turned_rad_ += rotationAngle(step.motion);
  for (int k = 0; k < kOffsets; ++k) {
    const Pose3 motion =
        other.poseAt(step.begin + offsetOf(k)).inverse() * other.poseAt(step.end + offsetOf(k));
    squares_[static_cast<size_t>(k)] +=
        std::pow(rotationAngle(Pose3(motion.inverse() * step.motion)), 2);
  }
}

std::optional<double> ClockOffset::seconds() const {
  const auto [least, most] = std::minmax_element(squares_.begin(), squares_.end());
  if (turned_rad_ < kEnoughRad || *most < kSharp * *least) return std::nullopt;
  if (least == squares_.begin() || least + 1 == squares_.end()) return std::nullopt;
  // The vertex of the parabola through the three.
  const double before = *(least - 1), after = *(least + 1);
  const double bend = before - 2.0 * *least + after;
  const double vertex = bend > 0 ? 0.5 * (before - after) / bend : 0.0;
  return offsetOf(static_cast<int>(least - squares_.begin())) + vertex * kStepS;
}

std::optional<double> ClockOffset::wrong() const {
  const auto offset = seconds();
  const double least = *std::min_element(squares_.begin(), squares_.end());
  if (!offset || std::abs(*offset) < kMattersS || squares_[kNone] < kWorse * least)
    return std::nullopt;
  return offset;
}

}  // namespace lamp
