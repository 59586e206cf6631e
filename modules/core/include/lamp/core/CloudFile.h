#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace lamp {

/** The points of a file, and what it says of them. */
struct CloudPoints {
  std::vector<Eigen::Vector3f> points;  ///< in the frame of the file, metres
  size_t not_finite = 0;                ///< points left out, since a coordinate was no number
  /** Where the sensor stood, in the same frame: a PCD file's VIEWPOINT. */
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
};

/** Reads `x y z` of a PLY or PCD file, whichever its name ends in; other fields are skipped. Not
 * read: big-endian PLY, PCD before 0.7.
 * \throws std::runtime_error naming the file, and the line in its text, if it cannot be read, is
 *    damaged, or has no point with finite coordinates. */
CloudPoints readCloudPoints(const std::string& path);

}  // namespace lamp
