#include "Png.h"

#include <png.h>

#include <ostream>
#include <stdexcept>
#include <string>

#include "lamp/core/Files.h"

namespace lamp {

namespace {

/** MRPT's own writer goes to a file whose name ends in .png, and does not say what went wrong. */
std::string encoded(const mrpt::img::CImage& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.getWidth());
  header.height = static_cast<png_uint_32>(image.getHeight());
  header.format = PNG_FORMAT_BGR;
  const auto stride = static_cast<png_int_32>(image.getRowStride());
  const uint8_t* const pixels = image.ptrLine<uint8_t>(0);
  constexpr int kAsItIs = 0;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(header), '\0');
  png_alloc_size_t size = bytes.size();
  if (!png_image_write_to_memory(&header, bytes.data(), &size, kAsItIs, pixels, stride, nullptr))
    throw std::runtime_error(std::string("cannot encode a picture as PNG: ") + header.message);
  bytes.resize(size);
  return bytes;
}

}  // namespace

void writePng(const mrpt::img::CImage& image, const std::string& path) {
  const std::string bytes = encoded(image);
  writeBinaryFile(path, [&](std::ostream& file) { file << bytes; });
}

}  // namespace lamp
