#pragma once

#include <string>

#include "lamp/core/CloudHeader.h"
#include "lamp/maps/MapExporter.h"

namespace lamp {

struct CloudPoint {
  Eigen::Vector3f position;  ///< in the frame of the map, metres
  Color color;
};

/** What differs between the kinds of cloud files. */
struct CloudFormat {
  std::string (*header)(const CloudLayout&);
  std::string first_comment;
  std::vector<CloudField> fields;  ///< those of a CloudPoint
  /** Appends the bytes of these fields. */
  void (*append)(const CloudPoint& point, std::string& bytes);
};

/** Streams the map's points to a file, with intensity if a scan has any, thinned by one voxel grid
 * over all scans if `voxel_m` is positive. \throws std::runtime_error naming the path. */
void writeCloud(const ComponentMap& map, double voxel_m, const CloudFormat& format,
                const std::string& path);

}  // namespace lamp
