#pragma once

#include <functional>
#include <istream>
#include <string>

#include "PcdHeader.h"

namespace lamp {

/** The points of a PCD file, version 0.7: ASCII, binary or compressed. */
class PcdFile {
 public:
  /** Reads the header. \throws std::runtime_error naming the file if it cannot be read, is no PCD,
   *  or is too short for its points. */
  explicit PcdFile(const std::string& path);

  const PcdHeader& header() const { return header_; }
  /** Calls `take` with x, y and z of each point, which may be no finite numbers.
   * \throws std::runtime_error naming the file, and the line if it is ASCII, where it is damaged.
   */
  void readXyz(const std::function<void(const double*)>& take) const;

 private:
  using Take = std::function<void(const double*)>;
  void checkSize() const;
  void readAscii(std::istream& file, const Take& take) const;
  void readBinary(std::istream& file, const Take& take) const;
  void readCompressed(std::istream& file, const Take& take) const;
  std::string decompressed(std::istream& file) const;
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  PcdHeader header_;
  size_t data_bytes_ = 0;    ///< behind the header
  std::streamoff data_ = 0;  ///< where the points begin
};

}  // namespace lamp
