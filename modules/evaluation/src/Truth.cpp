#include "lamp/evaluation/Truth.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace lamp::evaluation {

namespace {

namespace fs = std::filesystem;

/** Stems of `*.tum`, sorted. */
std::vector<std::string> trajectoriesIn(const std::string& folder) {
  std::vector<std::string> robots;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".tum") robots.push_back(entry.path().stem().string());
  std::sort(robots.begin(), robots.end());
  return robots;
}

std::vector<StampedPose> projected(std::vector<StampedPose> poses) {
  for (StampedPose& pose : poses) pose.pose = projectToPlane(pose.pose);
  return poses;
}

}  // namespace

TruthFolder::TruthFolder(const std::string& root) : root_(root), robots_(trajectoriesIn(root)) {
  if (robots_.empty()) {
    root_ = root + "/truth";
    robots_ = trajectoriesIn(root_);
  }
  if (robots_.empty())
    throw std::runtime_error("--truth '" + root +
                             "' contains no true trajectory: name a folder with <robot>.tum files");
}

bool TruthFolder::has(const std::string& robot) const {
  return std::binary_search(robots_.begin(), robots_.end(), robot);
}

TrueTrajectory::TrueTrajectory(std::vector<StampedPose> poses, bool planar)
    : poses_(planar ? projected(std::move(poses)) : std::move(poses)), interpolator_(poses_) {}

std::optional<Pose3> TrueTrajectory::at(double stamp) const {
  if (!(stamp >= begin() - kSameStamp && stamp <= end() + kSameStamp)) return std::nullopt;
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), stamp,
                                      [](const StampedPose& p, double t) { return p.stamp < t; });
  if (after != poses_.begin() && after != poses_.end()) {
    const double since = stamp - (after - 1)->stamp, until = after->stamp - stamp;
    if (since + until > kMaxGap && std::min(since, until) > kSameStamp) return std::nullopt;
  }
  return interpolator_.at(stamp);
}

}  // namespace lamp::evaluation
