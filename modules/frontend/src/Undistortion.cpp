#include "Undistortion.h"

#include <algorithm>

namespace lamp {

namespace {

/** Between so many moments of a sweep the robot moves evenly. */
constexpr int kMoments = 16;

}  // namespace

void undistort(const std::vector<float>& time, const std::function<Pose3(double time)>& pose_at,
               std::vector<Eigen::Vector3f>& points) {
  if (time.empty()) return;
  const auto [first, last] = std::minmax_element(time.begin(), time.end());
  const float begin = *first, span = *last - *first;
  if (!(span > 0)) return;
  std::vector<Eigen::Isometry3f> poses;
  for (int k = 0; k <= kMoments; ++k)
    poses.push_back(pose_at(begin + span * static_cast<double>(k) / kMoments).cast<float>());
  for (size_t i = 0; i < points.size(); ++i) {
    const float place = (time[i] - begin) / span * kMoments;
    const int k = std::clamp(static_cast<int>(place), 0, kMoments - 1);
    const float ratio = place - static_cast<float>(k);
    const Eigen::Vector3f before = poses[static_cast<size_t>(k)] * points[i];
    const Eigen::Vector3f after = poses[static_cast<size_t>(k) + 1] * points[i];
    points[i] = before + ratio * (after - before);
  }
}

}  // namespace lamp
