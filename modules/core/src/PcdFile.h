#pragma once

#include <functional>
#include <istream>
#include <memory>
#include <string>

#include "PcdHeader.h"

namespace lamp {

/** The points of a PCD file, ASCII, binary or compressed. */
class PcdFile {
 public:
  /** Reads the header. \throws std::runtime_error naming the file if it cannot be read, is no PCD,
   *  or is too short for its points. */
  explicit PcdFile(const std::string& path);
  /** \param file can be sought in; \param name of the file, for messages. */
  PcdFile(std::unique_ptr<std::istream> file, std::string name);

  const PcdHeader& header() const { return header_; }
  /** Calls `take` with x, y and z of each point, which may be no finite numbers.
   * \throws std::runtime_error naming the file, and the line if it is ASCII, where it is damaged.
   */
  void readXyz(const std::function<void(const double*)>& take) const;

 private:
  using Take = std::function<void(const double*)>;
  void checkSize() const;
  void readAscii(const Take& take) const;
  void readBinary(const Take& take) const;
  void readCompressed(const Take& take) const;
  std::string decompressed() const;
  [[noreturn]] void fail(const std::string& what) const;

  const std::unique_ptr<std::istream> file_;
  const std::string name_;
  const PcdHeader header_;
  std::streamoff data_ = 0;  ///< where the points begin
  size_t data_bytes_ = 0;    ///< behind the header
};

}  // namespace lamp
