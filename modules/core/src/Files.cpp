#include "lamp/core/Files.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace lamp {

void writeAtomically(const std::string& path,
                     const std::function<void(const std::string&)>& write) {
  const std::string temporary = path + ".tmp" + std::to_string(::getpid());
  std::error_code error, ignored;
  try {
    write(temporary);
  } catch (...) {
    std::filesystem::remove(temporary, ignored);
    throw;
  }
  std::filesystem::rename(temporary, path, error);
  if (!error) return;
  std::filesystem::remove(temporary, ignored);
  throw std::runtime_error("cannot write '" + path + "': " + error.message());
}

void writeTextFile(const std::string& path, const std::string& text) {
  writeAtomically(path, [&](const std::string& temporary) {
    std::ofstream file(temporary, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw std::runtime_error("cannot write '" + path + "': " + std::strerror(errno));
  });
}

std::string readTextFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || std::filesystem::is_directory(path) ||
      (file.peek() != EOF && !(text << file.rdbuf())))
    throw std::runtime_error(
        "cannot read '" + path + "': " +
        (std::filesystem::exists(path) ? "it is no readable file" : "there is no such file"));
  return text.str();
}

}  // namespace lamp
