#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <deque>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace lamp::test {

/** A new, empty folder that goes with the object. */
class TemporaryFolder {
 public:
  TemporaryFolder() : path_(testing::TempDir() + "lamp_test_XXXXXX") {
    if (!::mkdtemp(path_.data())) throw std::runtime_error("cannot make a folder like " + path_);
  }
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/** A new, empty folder, different on every call, that goes when the test program ends. */
inline std::string freshFolder() {
  static std::deque<TemporaryFolder> folders;
  return folders.emplace_back().path();
}

}  // namespace lamp::test
