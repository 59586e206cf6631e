#pragma once

#include <Eigen/Core>
#include <array>
#include <istream>
#include <string>
#include <vector>

#include "Scalar.h"

namespace lamp {

enum class PcdData { kAscii, kBinary, kBinaryCompressed };

/** A field of a PCD point: `count` numbers of one type. */
struct PcdField {
  std::string name;
  Scalar scalar;
  size_t count = 1;

  size_t bytes() const { return scalar.size * count; }
};

/** The header of a PCD file. */
struct PcdHeader {
  std::vector<PcdField> fields;
  size_t points = 0;
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();  ///< of the sensor, metres
  /** What to add to `x y z` for world coordinates: a line `# offset X Y Z`. */
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  PcdData data = PcdData::kAscii;
  size_t lines = 0;  ///< of the header itself

  /** Leaves the stream at the first point.
   * \throws std::runtime_error naming `path` and the line. */
  static PcdHeader read(std::istream& file, const std::string& path);

  size_t bytesPerPoint() const;
  size_t numbersPerPoint() const;
  /** Places of `x`, `y` and `z` in `fields`. */
  std::array<size_t, 3> xyz() const { return xyz_; }

 private:
  friend class PcdHeaderReader;
  std::array<size_t, 3> xyz_{};
};

}  // namespace lamp
