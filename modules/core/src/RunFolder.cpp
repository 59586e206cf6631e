#include "lamp/core/RunFolder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace lamp {

namespace fs = std::filesystem;

namespace {

/** The kernel frees the lock when the program ends, however it ends. */
std::shared_ptr<const void> lock(const std::string& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0)
    throw std::runtime_error("--out '" + folder +
                             "' cannot be opened: " + std::generic_category().message(errno));
  auto lock = std::shared_ptr<const int>(new int(file), [](const int* descriptor) {
    ::close(*descriptor);
    delete descriptor;
  });
  // Some network file systems know no such locks.
  if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw std::runtime_error("--out '" + folder +
                             "' is being written by another program: name another folder");
  return lock;
}

}  // namespace

RunFolder RunFolder::create(const std::string& root) {
  std::error_code error;
  if (fs::exists(root, error) && !fs::is_directory(root))
    throw std::runtime_error("--out '" + root + "' is a file: name a folder");
  if (!error) fs::create_directories(root, error);
  if (!error && ::access(root.c_str(), W_OK) != 0)
    error = std::error_code(errno, std::generic_category());
  if (error) throw std::runtime_error("--out '" + root + "' cannot be written: " + error.message());
  RunFolder folder(root);
  folder.lock_ = lock(root);
  if (!fs::is_empty(root))
    throw std::runtime_error("--out '" + root +
                             "' holds files already: name a new folder, or empty it first");
  return folder;
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
