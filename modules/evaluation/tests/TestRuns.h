#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "TemporaryFolder.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"
#include "lamp/core/RunFolder.h"
#include "lamp/core/Trajectory.h"

namespace lamp::test {

using namespace evaluation;

constexpr double kDegree = M_PI / 180.0;

/** What the call throws, or an empty string. */
inline std::string thrownBy(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

inline Pose3 pose(double x, double y, double z, double yaw = 0, double pitch = 0, double roll = 0) {
  Vector6d v;
  v << x, y, z, yaw, pitch, roll;
  return poseFromYawPitchRoll(v);
}

using Path = std::vector<StampedPose>;

/** `n` poses, 0.1 s and about 0.5 m apart, on a winding climb that is like no line or circle. */
inline Path windingPath(size_t n, double start_stamp = 100, double bend = 0.3) {
  Path path;
  Pose3 T = Pose3::Identity();
  for (size_t i = 0; i < n; ++i) {
    path.push_back({start_stamp + 0.1 * static_cast<double>(i), T});
    Vector6d step = Vector6d::Zero();
    step << 0.5, 0, 0.02 * std::sin(0.2 * static_cast<double>(i)), 0, 0,
        bend * std::sin(0.07 * static_cast<double>(i));
    T = normalized(T * expSE3(step));
  }
  return path;
}

/** `n` poses along x, `step` metres and 0.1 s apart. */
inline Path straightPath(size_t n, double step, double start_stamp = 100) {
  Path path;
  for (size_t i = 0; i < n; ++i)
    path.push_back(
        {start_stamp + 0.1 * static_cast<double>(i), pose(step * static_cast<double>(i), 0, 0)});
  return path;
}

inline Path moved(Path path, const Pose3& T) {
  for (StampedPose& p : path) p.pose = T * p.pose;
  return path;
}

/** A run folder and a folder of its truth, written by hand. */
class TestRun {
 public:
  explicit TestRun(const std::string& root) : root_(root), folder_(root + "/run") {
    folder_.createSubfolders();
    std::filesystem::create_directories(truth());
  }
  const RunFolder& folder() const { return folder_; }
  std::string root() const { return folder_.root(); }
  std::string truth() const { return root_ + "/truth_of_it"; }
  /** Of a file beside the two. */
  std::string beside(const std::string& name) const { return root_ + "/" + name; }

  /** A robot with its estimated path and truth; the odometry is the path too. */
  void addRobot(const std::string& name, const Path& estimate, const Path& true_path,
                size_t component = 0, bool planar = false) {
    writeTextFile(folder_.trajectory(name), toTum(estimate));
    writeTextFile(folder_.odometryTrajectory(name), toTum(estimate));
    if (!true_path.empty()) writeTextFile(truth() + "/" + name + ".tum", toTum(true_path));
    robots_ += std::string(robots_.empty() ? "" : ",") + R"({"name":")" + name + R"(","planar":)" +
               (planar ? "true" : "false") + "}";
    if (components_.size() <= component) components_.resize(component + 1);
    components_[component] += (components_[component].empty() ? "\"" : ",\"") + name + "\"";
    writeSummary();
  }
  void writeSummary(bool interrupted = false) const {
    std::string components;
    for (size_t i = 0; i < components_.size(); ++i)
      components += std::string(i == 0 ? "" : ",") + R"({"map":"maps/map)" +
                    (i == 0 ? "" : "_" + std::to_string(i + 1)) + R"(","robots":[)" +
                    components_[i] + "]}";
    writeTextFile(folder_.summary(), std::string(R"({"interrupted":)") +
                                         (interrupted ? "true" : "false") + R"(,"robots":[)" +
                                         robots_ + R"(],"components":[)" + components + "]}");
  }

 private:
  std::string root_;
  RunFolder folder_;
  std::string robots_;
  std::vector<std::string> components_;
};

}  // namespace lamp::test
