#include "BinaryFile.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "lamp/core/Files.h"

namespace lamp {

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

}  // namespace lamp
