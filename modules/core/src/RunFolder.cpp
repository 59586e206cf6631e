#include "lamp/core/RunFolder.h"

#include <unistd.h>

#include <filesystem>
#include <stdexcept>

namespace lamp {

namespace fs = std::filesystem;

RunFolder RunFolder::create(const std::string& root) {
  std::error_code error;
  if (fs::exists(root, error)) {
    if (!fs::is_directory(root))
      throw std::runtime_error("--out '" + root + "' is a file: name a folder");
    if (!fs::is_empty(root, error) && !error)
      throw std::runtime_error("--out '" + root +
                               "' holds files already: name a new folder, or empty it first");
  }
  if (!error) fs::create_directories(root, error);
  if (!error && ::access(root.c_str(), W_OK) != 0)
    error = std::make_error_code(std::errc::permission_denied);
  if (error) throw std::runtime_error("--out '" + root + "' cannot be written: " + error.message());
  return RunFolder(root);
}

void RunFolder::createSubfolders() const {
  for (const char* name : {"trajectories", "keyframes", "maps"}) {
    std::error_code error;
    fs::create_directories(fs::path(root_) / name, error);
    if (error)
      throw std::runtime_error("cannot make the folder '" + root_ + "/" + name +
                               "': " + error.message());
  }
}

std::string RunFolder::trajectory(const std::string& robot) const {
  return root_ + "/trajectories/" + robot + ".tum";
}
std::string RunFolder::keyNodeTrajectory(const std::string& robot) const {
  return root_ + "/trajectories/" + robot + ".keyframes.tum";
}
std::string RunFolder::odometryTrajectory(const std::string& robot) const {
  return root_ + "/trajectories/" + robot + ".odometry.tum";
}
std::string RunFolder::keyNodes(const std::string& robot) const {
  return root_ + "/keyframes/" + robot + ".rawlog";
}
std::string RunFolder::mapStem(size_t component_rank) const {
  return root_ + "/maps/map" +
         (component_rank == 0 ? "" : "_" + std::to_string(component_rank + 1));
}

}  // namespace lamp
