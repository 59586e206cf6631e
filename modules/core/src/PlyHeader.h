#pragma once

#include <Eigen/Core>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "Scalar.h"

namespace lamp {

enum class PlyData { kAscii, kLittleEndian, kBigEndian };

struct PlyProperty {
  std::string name;
  Scalar scalar;                 ///< of its values
  std::optional<Scalar> length;  ///< of a list: how the number of values is stored
};

struct PlyElement {
  std::string name;
  size_t count = 0;
  std::vector<PlyProperty> properties;

  bool hasLists() const;
  /** Bytes of one, binary; with empty lists. */
  size_t bytes() const;
};

struct PlyHeader {
  PlyData data = PlyData::kAscii;
  std::vector<PlyElement> elements;  ///< in the order of the file
  size_t vertices = 0;               ///< which of them are the vertices
  size_t lines = 0;                  ///< of the header itself
  /** What is to be added to `x y z` to get world coordinates: a line `comment offset X Y Z`. */
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();

  const PlyElement& vertex() const { return elements[vertices]; }

  /** Leaves the stream at the first element. \throws std::runtime_error naming `name` and the line.
   */
  static PlyHeader read(std::istream& file, const std::string& name);
};

}  // namespace lamp
