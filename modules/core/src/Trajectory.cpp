#include "lamp/core/Trajectory.h"

#include <algorithm>
#include <stdexcept>

#include "TumText.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"

namespace lamp {

namespace {

/** Seconds in a unit of the stamps: recordings are of our days, so the largest tells the unit. */
double unitOf(double greatest) {
  if (greatest > 1e17) return 1e-9;
  if (greatest > 1e14) return 1e-6;
  return greatest > 1e11 ? 1e-3 : 1.0;
}

StampedPose poseOf(const TumRow& row, double unit, const std::string& where) {
  const auto& v = row.values;
  const Eigen::Quaterniond q(v[7], v[4], v[5], v[6]);
  if (!(q.norm() > 1e-6))
    throw std::runtime_error(where + ":" + std::to_string(row.line) +
                             ": the quaternion qx qy qz qw is zero");
  StampedPose pose;
  pose.stamp = v[0] * unit;
  pose.pose.translation() << v[1], v[2], v[3];
  pose.pose.linear() = q.normalized().toRotationMatrix();
  return pose;
}

/** Stamps that were written with too few digits repeat although the poses differ. */
void refuseRoundedStamps(const std::vector<TumRow>& rows, const std::string& where) {
  size_t repeated = 0, first = 0;
  for (size_t i = 1; i < rows.size(); ++i) {
    const auto &before = rows[i - 1].values, &here = rows[i].values;
    if (here[0] == before[0] && here != before && repeated++ == 0) first = i;
  }
  if (repeated < 3 || 10 * repeated < rows.size()) return;
  throw std::runtime_error(where + ":" + std::to_string(rows[first].line) +
                           ": the stamp is that of the line before, as in " +
                           std::to_string(repeated) +
                           " lines; write stamps with all their digits (%.6f)");
}

}  // namespace

std::string toTum(const std::vector<StampedPose>& trajectory) {
  std::string text;
  for (const StampedPose& p : trajectory) {
    const Eigen::Quaterniond q(p.pose.linear());
    text += formatFixed(p.stamp, 6);
    for (const double v : {p.pose.translation().x(), p.pose.translation().y(),
                           p.pose.translation().z(), q.x(), q.y(), q.z(), q.w()})
      text += " " + formatFixed(v, 9);
    text += "\n";
  }
  return text;
}

std::vector<StampedPose> readTum(const std::string& path) {
  const std::vector<TumRow> rows = parseTum(readTextFile(path), path);
  if (rows.empty()) throw std::runtime_error(path + ": holds no pose");
  refuseRoundedStamps(rows, path);
  double greatest = 0;
  for (const TumRow& row : rows) greatest = std::max(greatest, row.values[0]);
  std::vector<StampedPose> trajectory;
  for (const TumRow& row : rows) trajectory.push_back(poseOf(row, unitOf(greatest), path));
  std::stable_sort(trajectory.begin(), trajectory.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; });
  const auto same = [](const StampedPose& a, const StampedPose& b) { return a.stamp == b.stamp; };
  trajectory.erase(std::unique(trajectory.begin(), trajectory.end(), same), trajectory.end());
  return trajectory;
}

TrajectoryInterpolator::TrajectoryInterpolator(std::vector<StampedPose> trajectory)
    : trajectory_(std::move(trajectory)) {
  if (trajectory_.empty()) throw std::logic_error("TrajectoryInterpolator: no poses");
}

Pose3 TrajectoryInterpolator::at(double stamp) const {
  const auto after = std::lower_bound(trajectory_.begin(), trajectory_.end(), stamp,
                                      [](const StampedPose& p, double t) { return p.stamp < t; });
  if (after == trajectory_.begin()) return trajectory_.front().pose;
  if (after == trajectory_.end()) return trajectory_.back().pose;
  const auto before = after - 1;
  return interpolate(before->pose, after->pose,
                     (stamp - before->stamp) / (after->stamp - before->stamp));
}

}  // namespace lamp
