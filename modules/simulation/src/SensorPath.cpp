#include "SensorPath.h"

#include <algorithm>

namespace lamp::simulation {

SensorPath::SensorPath(const std::function<Pose3(double)>& poseAt, double begin, double duration) {
  constexpr int kIntervals = 32;
  spacing_ = duration / kIntervals;
  for (int i = 0; i <= kIntervals; ++i) {
    const Pose3 pose = poseAt(begin + i * spacing_);
    Support support{Eigen::Quaterniond(pose.linear()), pose.translation()};
    // Of the two quaternions of a rotation, the one next to its neighbour.
    if (i > 0 && support.rotation.dot(supports_.back().rotation) < 0)
      support.rotation.coeffs() *= -1.0;
    supports_.push_back(support);
  }
}

Eigen::Isometry3f SensorPath::at(double delay) const {
  const double place = std::clamp(delay / spacing_, 0.0, double(supports_.size() - 1));
  const size_t before = std::min(static_cast<size_t>(place), supports_.size() - 2);
  const double ratio = place - static_cast<double>(before);
  const Support &a = supports_[before], &b = supports_[before + 1];
  Eigen::Quaterniond rotation;
  rotation.coeffs() = (1.0 - ratio) * a.rotation.coeffs() + ratio * b.rotation.coeffs();
  Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
  pose.linear() = rotation.normalized().cast<float>().toRotationMatrix();
  pose.translation() = ((1.0 - ratio) * a.position + ratio * b.position).cast<float>();
  return pose;
}

}  // namespace lamp::simulation
