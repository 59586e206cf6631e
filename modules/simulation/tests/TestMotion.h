#pragma once

#include <functional>
#include <vector>

#include "lamp/core/Trajectory.h"

namespace lamp::test {

using namespace simulation;

constexpr double kBegin = 1.7e9;

/** Samples a motion from `kBegin` on, every 10 ms. \param pose by seconds since the begin. */
inline TrajectoryInterpolator motion(double seconds, const std::function<Pose3(double)>& pose) {
  std::vector<StampedPose> samples;
  const int count = static_cast<int>(std::round(seconds * 100.0));
  for (int i = 0; i <= count; ++i) samples.push_back({kBegin + 0.01 * i, pose(0.01 * i)});
  return TrajectoryInterpolator(std::move(samples));
}

inline TrajectoryInterpolator standing(double seconds, const Pose3& pose = Pose3::Identity()) {
  return motion(seconds, [&](double) { return pose; });
}

/** A constant twist `[m/s, rad/s]` in the base frame. */
inline TrajectoryInterpolator steady(double seconds, const Vector6d& twist) {
  return motion(seconds, [&](double t) { return expSE3(t * twist); });
}

/** 1 m/s, winding and hilly: yaw swings by 1 rad, pitch by 0.1 rad; sampled every 0.1 s. */
inline TrajectoryInterpolator winding(double seconds) {
  std::vector<StampedPose> samples{{kBegin, Pose3::Identity()}};
  for (int i = 1; i <= static_cast<int>(seconds * 10); ++i) {
    const double t = 0.1 * i;
    Pose3 next = samples.back().pose;
    next.translation() += 0.1 * next.linear().col(0);
    Vector6d angles = Vector6d::Zero();
    angles[3] = 2.0 * std::sin(0.08 * t);
    angles[4] = 0.1 * std::sin(0.05 * t);
    next.linear() = poseFromYawPitchRoll(angles).linear();
    samples.push_back({kBegin + t, next});
  }
  return TrajectoryInterpolator(std::move(samples));
}

}  // namespace lamp::test
