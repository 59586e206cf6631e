#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace lamp {

enum class CloudScalar { kFloat, kUint8 };

struct CloudField {
  std::string name;
  CloudScalar scalar = CloudScalar::kFloat;
};

/** What a cloud file says before its points, which follow as bytes: little endian, without gaps. */
struct CloudLayout {
  std::vector<std::string> comments;
  std::vector<CloudField> fields;
  size_t points = 0;
};

/** The header of a PLY file. */
std::string plyHeader(const CloudLayout& layout);
/** The header of a PCD file. */
std::string pcdHeader(const CloudLayout& layout);

/** `offset X Y Z` in whole metres: the comment that says what to add to the points for world
 * coordinates. Empty if that is nothing. */
std::string offsetComment(const Eigen::Vector3d& offset);

/** Appends a number's bytes in little-endian order. */
template <class Number>
void appendBytes(Number value, std::string& bytes) {
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the formats are little endian");
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}
/** Appends x, y and z. */
inline void appendBytes(const Eigen::Vector3f& vector, std::string& bytes) {
  for (const float coordinate : vector) appendBytes(coordinate, bytes);
}

}  // namespace lamp
