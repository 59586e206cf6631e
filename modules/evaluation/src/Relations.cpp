#include "lamp/evaluation/Relations.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "NumberRows.h"
#include "lamp/core/Csv.h"
#include "lamp/evaluation/Truth.h"

namespace lamp::evaluation {

namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kShort = 5.0;  // seconds

const Pose3* poseAt(const std::vector<StampedPose>& trajectory, double stamp) {
  const auto found =
      std::lower_bound(trajectory.begin(), trajectory.end(), stamp - TrueTrajectory::kSameStamp,
                       [](const StampedPose& pose, double t) { return pose.stamp < t; });
  if (found == trajectory.end() || found->stamp > stamp + TrueTrajectory::kSameStamp)
    return nullptr;
  return &found->pose;
}

struct Errors {
  std::vector<double> translation_m, rotation_deg;

  void add(const Pose3& error) {
    translation_m.push_back(error.translation().norm());
    rotation_deg.push_back(rotationAngle(error) / kDegree);
  }
  RelationError statistics() const {
    return {Statistics::of(translation_m), Statistics::of(rotation_deg)};
  }
};

}  // namespace

std::vector<Relation> readRelations(const std::string& path) {
  std::vector<Relation> relations;
  readNumberRows(path, 8, "stamp1 stamp2 x y z roll pitch yaw", [&](const std::vector<double>& v) {
    Vector6d pose;
    pose << v[2], v[3], v[4], v[7], v[6], v[5];
    relations.push_back({v[0], v[1], poseFromYawPitchRoll(pose)});
  });
  return relations;
}

std::vector<StampedPose> withRelationStamps(std::vector<StampedPose> trajectory,
                                            const std::string& scan_stamps) {
  size_t place = 0;
  readNumberRows(scan_stamps, 3, "number stamp stamp", [&](const std::vector<double>& v) {
    if (place == trajectory.size()) return;
    if (std::abs(trajectory[place].stamp - v[2]) <= TrueTrajectory::kSameStamp)
      trajectory[place++].stamp = v[1];
  });
  if (place != trajectory.size())
    throw std::runtime_error(scan_stamps + " has no row for the scan at " +
                             formatFixed(trajectory[place].stamp, 6) +
                             " s: is it of another recording?");
  return trajectory;
}

RelationErrors relationErrors(const std::vector<StampedPose>& trajectory,
                              const std::vector<Relation>& relations) {
  Errors all, below, above;
  RelationErrors result;
  for (const Relation& relation : relations) {
    const Pose3* from = poseAt(trajectory, relation.from);
    const Pose3* to = poseAt(trajectory, relation.to);
    if (!from || !to) {
      ++result.without_pose;
      continue;
    }
    const Pose3 error = relation.from_T_to.inverse() * (from->inverse() * *to);
    all.add(error);
    (std::abs(relation.to - relation.from) < kShort ? below : above).add(error);
  }
  if (all.translation_m.empty())
    throw std::runtime_error(
        "no relation is between two scans of the run: " + std::to_string(relations.size()) +
        " relations, the first from " + formatFixed(relations.front().from, 3) +
        " s; the run is of " + formatFixed(trajectory.front().stamp, 3) + " to " +
        formatFixed(trajectory.back().stamp, 3) + " s");
  result.all = all.statistics();
  result.below_5_s = below.statistics();
  result.from_5_s = above.statistics();
  return result;
}

}  // namespace lamp::evaluation
