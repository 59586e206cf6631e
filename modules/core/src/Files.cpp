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
  if (!*file || std::filesystem::is_directory(path))
    throw std::runtime_error(
        "cannot read '" + path + "': " +
        (std::filesystem::exists(path) ? "it is no readable file" : "there is no such file"));
  return file;
}

std::string readTextFile(const std::string& path) {
  const auto file = openedToRead(path);
  std::ostringstream text;
  if (file->peek() != EOF && !(text << file->rdbuf()))
    throw std::runtime_error("cannot read '" + path + "': it is no readable file");
  return text.str();
}

}  // namespace lamp
