#include "lamp/evaluation/TrajectoryError.h"

#include <cmath>

namespace lamp::evaluation {

namespace {

constexpr double kDegree = M_PI / 180.0;

template <class T>
void appendTo(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

std::optional<double> meanOf(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return Statistics::of(values).mean;
}

/** Distance travelled on the true path at each pose. */
std::vector<double> travelled(const std::vector<JoinedPose>& poses) {
  std::vector<double> distance(poses.size(), 0.0);
  for (size_t i = 1; i < poses.size(); ++i)
    distance[i] =
        distance[i - 1] + (poses[i].truth.translation() - poses[i - 1].truth.translation()).norm();
  return distance;
}

/** error = true_motion⁻¹ · estimated_motion */
Pose3 motionError(const JoinedPose& from, const JoinedPose& to) {
  return (from.truth.inverse() * to.truth).inverse() * (from.estimate.inverse() * to.estimate);
}

}  // namespace

void TrajectoryError::append(const TrajectoryError& other) {
  appendTo(distance_m, other.distance_m);
  appendTo(position_m, other.position_m);
  appendTo(rotation_deg, other.rotation_deg);
}

TrajectoryError trajectoryError(const std::vector<JoinedPose>& poses,
                                const Pose3& truth_T_estimate) {
  TrajectoryError error;
  error.distance_m = travelled(poses);
  for (const JoinedPose& pose : poses) {
    const Pose3 aligned = truth_T_estimate * pose.estimate;
    error.position_m.push_back((aligned.translation() - pose.truth.translation()).norm());
    error.rotation_deg.push_back(rotationAngle(pose.truth.inverse() * aligned) / kDegree);
  }
  return error;
}

void Drift::append(const Drift& other) {
  appendTo(translation_percent, other.translation_percent);
  appendTo(rotation_deg_per_m, other.rotation_deg_per_m);
}
std::optional<double> Drift::meanTranslation() const {
  return meanOf(translation_percent);
}
std::optional<double> Drift::meanRotation() const {
  return meanOf(rotation_deg_per_m);
}

Drift drift(const std::vector<JoinedPose>& poses, double segment_m) {
  // Lets a path of 0.1 m steps reach its 10 m with the hundredth.
  constexpr double kRounding = 1e-6;
  Drift result;
  const std::vector<double> distance = travelled(poses);
  size_t end = 0;
  for (size_t begin = 0; begin < poses.size(); ++begin) {
    while (end < poses.size() && distance[end] - distance[begin] < segment_m - kRounding) ++end;
    if (end == poses.size()) break;
    const bool complete = poses[end].row - poses[begin].row == end - begin;
    if (!complete) continue;
    const double length = distance[end] - distance[begin];
    const Pose3 error = motionError(poses[begin], poses[end]);
    result.translation_percent.push_back(100.0 * error.translation().norm() / length);
    result.rotation_deg_per_m.push_back(rotationAngle(error) / kDegree / length);
  }
  return result;
}

}  // namespace lamp::evaluation
