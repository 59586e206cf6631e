#pragma once

#include <zlib.h>

#include <cstddef>
#include <string>

namespace lamp {

/** A gz file to write to. Unlike MRPT's stream it tells when the disk is full. The header carries
 * no time and no name, so equal content gives equal bytes. */
class GzFile {
 public:
  /** \param shown_path stands for `path` in messages. \throws std::runtime_error */
  GzFile(const std::string& path, const std::string& shown_path);
  GzFile(const GzFile&) = delete;
  GzFile& operator=(const GzFile&) = delete;
  ~GzFile();

  /** \throws std::runtime_error naming the path. */
  void write(const void* data, size_t size);
  /** Must be called for the file to be complete. \throws std::runtime_error naming the path. */
  void close();

 private:
  [[noreturn]] void fail() const;

  gzFile file_;
  std::string shown_path_;
};

}  // namespace lamp
