#include "Measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>

namespace lamp::test {

namespace {

constexpr double kSameStamp = 1e-4;  ///< files keep six decimals

const Pose3& poseAt(const std::vector<StampedPose>& trajectory, double stamp) {
  const auto found =
      std::lower_bound(trajectory.begin(), trajectory.end(), stamp - kSameStamp,
                       [](const StampedPose& pose, double t) { return pose.stamp < t; });
  if (found == trajectory.end() || found->stamp > stamp + kSameStamp)
    throw std::runtime_error("no pose at the stamp " + std::to_string(stamp));
  return found->pose;
}

}  // namespace

double ateFromFirst(const std::vector<StampedPose>& estimate,
                    const std::vector<StampedPose>& truth) {
  const Pose3 truth_T_estimate =
      poseAt(truth, estimate.at(0).stamp) * estimate.at(0).pose.inverse();
  double sum = 0;
  for (const StampedPose& pose : estimate)
    sum += ((truth_T_estimate * pose.pose).translation() - poseAt(truth, pose.stamp).translation())
               .squaredNorm();
  return std::sqrt(sum / static_cast<double>(estimate.size()));
}

size_t occupiedCells(const std::vector<Eigen::Vector3f>& points, double edge_m) {
  std::set<std::array<int, 3>> cells;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3i cell = (point / static_cast<float>(edge_m)).array().floor().cast<int>();
    cells.insert({cell.x(), cell.y(), cell.z()});
  }
  return cells.size();
}

}  // namespace lamp::test
