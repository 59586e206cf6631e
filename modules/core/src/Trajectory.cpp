#include "lamp/core/Trajectory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"
#include "lamp/core/Ini.h"

namespace lamp {

namespace {

StampedPose parseTumRow(const std::vector<std::string>& words, const std::string& where) {
  std::array<double, 8> v;
  bool good = words.size() == v.size();
  for (size_t i = 0; good && i < v.size(); ++i)
    good = parseDouble(words[i], v[i]) && std::isfinite(v[i]);
  const Eigen::Quaterniond q =
      good ? Eigen::Quaterniond(v[7], v[4], v[5], v[6]) : Eigen::Quaterniond(0, 0, 0, 0);
  if (!good || !(q.norm() > 1e-6))
    throw std::runtime_error(where + ": is no 'stamp x y z qx qy qz qw'");
  StampedPose row;
  row.stamp = v[0];
  row.pose.translation() << v[1], v[2], v[3];
  row.pose.linear() = q.normalized().toRotationMatrix();
  return row;
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
  std::istringstream in(readTextFile(path));
  std::vector<StampedPose> trajectory;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::replace(line.begin(), line.end(), '\t', ' ');
    std::replace(line.begin(), line.end(), '\r', ' ');
    const auto words = splitWords(line.substr(0, line.find('#')), ' ');
    if (!words.empty())
      trajectory.push_back(parseTumRow(words, path + ":" + std::to_string(number)));
  }
  if (trajectory.empty()) throw std::runtime_error(path + ": holds no pose");
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
