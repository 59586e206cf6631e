#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

namespace lamp::fuzz {

/** Ends the program, which libFuzzer reports as a crash of the input at hand. */
inline void require(bool holds, const std::string& what) {
  if (holds) return;
  std::cerr << "violated: " << what << "\n";
  std::abort();
}

/** Calls a reader, which may refuse its input with a std::runtime_error that says in which file.
 * Every other exception is an uncaught one, and so a crash. */
template <class Read>
void mayRefuse(const std::string& name, const Read& read) {
  try {
    read();
  } catch (const std::runtime_error& refusal) {
    const std::string message = refusal.what();
    require(message.find(name) != std::string::npos, "the message names the file: " + message);
  }
}

/** The input as a text. */
inline std::string textOf(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/** The input as a file, for readers that want a path: one file a process, overwritten each time; in
 * memory where the system has a folder for that. */
inline std::string fileOf(const uint8_t* data, size_t size, const std::string& extension) {
  static const std::filesystem::path folder =
      std::filesystem::exists("/dev/shm") ? "/dev/shm" : std::filesystem::temp_directory_path();
  const std::string path = folder / ("lamp_fuzz_" + std::to_string(getpid()) + extension);
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return path;
}

}  // namespace lamp::fuzz
