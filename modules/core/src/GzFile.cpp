#include "GzFile.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace lamp {

GzFile::GzFile(const std::string& path, const std::string& shown_path)
    : file_(gzopen(path.c_str(), "wb6")), shown_path_(shown_path) {
  if (!file_) fail();
}

GzFile::~GzFile() {
  if (file_) gzclose(file_);
}

void GzFile::write(const void* data, size_t size) {
  constexpr size_t kBlock = 1 << 24;  // zlib counts in int
  const char* from = static_cast<const char*>(data);
  while (size > 0) {
    const size_t block = std::min(size, kBlock);
    if (gzwrite(file_, from, static_cast<unsigned>(block)) != static_cast<int>(block)) fail();
    from += block;
    size -= block;
  }
}

void GzFile::close() {
  const gzFile file = file_;
  file_ = nullptr;
  if (gzclose(file) != Z_OK) fail();
}

void GzFile::fail() const {
  throw std::runtime_error("cannot write '" + shown_path_ + "': " + std::strerror(errno) +
                           "; check that its folder exists and has room");
}

}  // namespace lamp
