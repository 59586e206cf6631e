#include "Png.h"

#include <filesystem>
#include <stdexcept>

#include "lamp/core/Files.h"

namespace lamp {

void writePng(const mrpt::img::CImage& image, const std::string& path) {
  writeAtomically(path, [&](const std::string& temporary) {
    // MRPT takes the format from the file's ending.
    const std::string png = temporary + ".png";
    const bool written = image.saveToFile(png);
    if (written) return std::filesystem::rename(png, temporary);
    std::filesystem::remove(png);
    throw std::runtime_error("cannot write '" + path +
                             "': check that its folder exists and has room");
  });
}

}  // namespace lamp
