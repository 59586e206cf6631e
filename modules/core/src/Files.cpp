#include "lamp/core/Files.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <set>
#include <sstream>
#include <stdexcept>

namespace lamp {

namespace fs = std::filesystem;

namespace {

/** The temporary files that threads are writing. */
struct Unfinished {
  std::mutex mutex;
  std::set<std::string> paths;
};

Unfinished& unfinished() {
  static auto* const files = new Unfinished;  // outlives all threads
  return *files;
}

/** A temporary file, removed unless it is given its final name. */
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string path) : path_(std::move(path)) {
    const std::lock_guard<std::mutex> lock(unfinished().mutex);
    unfinished().paths.insert(path_);
  }
  ~TemporaryFile() {
    std::error_code ignored;
    const std::lock_guard<std::mutex> lock(unfinished().mutex);
    if (unfinished().paths.erase(path_) > 0) fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void renameTo(const fs::path& target, std::error_code& error) const {
    const std::lock_guard<std::mutex> lock(unfinished().mutex);
    fs::rename(path_, target, error);
    if (!error) unfinished().paths.erase(path_);
  }

 private:
  const std::string path_;
};

/** Where a path leads. */
struct Destination {
  fs::path path;          ///< with symbolic links followed, though the last may lead nowhere yet
  bool in_place = false;  ///< no file of its own that could be replaced
};

/** /dev/stdout and the like lead into /proc: what they name is open already, and replacing it would
 * cut it off from whoever opened it. */
Destination destinationOf(const std::string& path) {
  constexpr int kMaxLinks = 40;
  std::error_code error;
  fs::path at = path;
  for (int links = 0; links < kMaxLinks; ++links) {
    const fs::path folder = fs::weakly_canonical(fs::absolute(at).parent_path(), error);
    if (*std::next(folder.begin(), folder.has_relative_path() ? 1 : 0) == "proc") return {at, true};
    const fs::path next = fs::read_symlink(at, error);
    if (error) break;
    at = folder / next;
  }
  const fs::file_status status = fs::status(at, error);
  return {at, fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)};
}

}  // namespace

void writeAtomically(const std::string& path,
                     const std::function<void(const std::string&)>& write) {
  const Destination destination = destinationOf(path);
  if (destination.in_place) return write(path);
  const std::string temporary = destination.path.string() + ".tmp" + std::to_string(::getpid());
  const TemporaryFile file(temporary);
  write(temporary);
  std::error_code error;
  file.renameTo(destination.path, error);
  if (error) throw std::runtime_error("cannot write '" + path + "': " + error.message());
}

void removeUnfinishedFiles() {
  unfinished().mutex.lock();  // for good
  std::error_code ignored;
  for (const std::string& path : unfinished().paths) fs::remove(path, ignored);
}

void writeBinaryFile(const std::string& path, const std::function<void(std::ostream&)>& write) {
  writeAtomically(path, [&](const std::string& temporary) {
    const auto check = [&path](const std::ofstream& file) {
      if (file) return;
      throw std::runtime_error("cannot write '" + path + "': " + std::strerror(errno) +
                               "; check that its folder exists and has room");
    };
    std::ofstream file(temporary, std::ios::binary);
    check(file);
    write(file);
    file.close();
    check(file);
  });
}

void writeTextFile(const std::string& path, const std::string& text) {
  writeBinaryFile(path, [&](std::ostream& file) { file << text; });
}

std::unique_ptr<std::istream> openedToRead(const std::string& path) {
  auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
  if (!*file || fs::is_directory(path))
    throw std::runtime_error(
        "cannot read '" + path +
        "': " + (fs::exists(path) ? "it is not a readable file" : "there is no such file"));
  return file;
}

std::string readTextFile(const std::string& path) {
  const auto file = openedToRead(path);
  std::ostringstream text;
  if (file->peek() != EOF && !(text << file->rdbuf()))
    throw std::runtime_error("cannot read '" + path + "': it is not a readable file");
  return text.str();
}

}  // namespace lamp
