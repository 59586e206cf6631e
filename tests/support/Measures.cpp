#include "Measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
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

std::vector<Relation> readRelations(const std::string& path) {
  std::ifstream file(path);
  std::vector<Relation> relations;
  double from, to, x, y, z, roll, pitch, yaw;
  while (file >> from >> to >> x >> y >> z >> roll >> pitch >> yaw) {
    Vector6d pose;
    pose << x, y, z, yaw, pitch, roll;
    relations.push_back({from, to, poseFromYawPitchRoll(pose)});
  }
  return relations;
}

RelationError relationError(const std::vector<StampedPose>& trajectory,
                            const std::vector<Relation>& relations, double min_seconds,
                            double max_seconds) {
  RelationError mean;
  for (const Relation& relation : relations) {
    const double seconds = std::abs(relation.to - relation.from);
    if (seconds < min_seconds || seconds >= max_seconds) continue;
    const Pose3 estimated =
        poseAt(trajectory, relation.from).inverse() * poseAt(trajectory, relation.to);
    const Pose3 error = relation.from_T_to.inverse() * estimated;
    mean.metres += error.translation().norm();
    mean.radians += rotationAngle(error);
    ++mean.relations;
  }
  mean.metres /= static_cast<double>(mean.relations);
  mean.radians /= static_cast<double>(mean.relations);
  return mean;
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
