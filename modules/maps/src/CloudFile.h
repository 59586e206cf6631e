#pragma once

#include <cstddef>
#include <string>

#include "lamp/maps/MapExporter.h"

namespace lamp {

struct CloudPoint {
  Eigen::Vector3f position;  ///< in the frame of the map, metres
  Color color;
  float intensity;
};

/** What the text header of a cloud file says. */
struct CloudHeader {
  size_t count = 0;
  bool has_intensity = false;
  std::string offset;   ///< offsetText(): goes into a comment of its own
  std::string padding;  ///< goes into a comment, so that headers of any count can be equally long
};

/** How a cloud file looks: a text header, then the points as bytes. */
struct CloudFormat {
  std::string (*header)(const CloudHeader&);
  /** Appends the bytes of one point. */
  void (*append)(const CloudPoint& point, bool has_intensity, std::string& bytes);
};

/** Streams the map's points to a file, thinned by one voxel grid over all scans if `voxel_m` is
 * positive. \throws std::runtime_error naming the path. */
void writeCloud(const ComponentMap& map, double voxel_m, const CloudFormat& format,
                const std::string& path);

/** Appends a number's bytes in little-endian order. */
template <class Number>
void appendBytes(Number value, std::string& bytes) {
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the formats are little endian");
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

}  // namespace lamp
