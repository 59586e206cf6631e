#pragma once

#include <Eigen/Core>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lamp {

/** The points of a file, and what it says of them. */
struct CloudPoints {
  std::vector<Eigen::Vector3f> points;  ///< in world coordinates less the offset, metres
  /** What to add for world coordinates: what the file states as `offset X Y Z` in a comment, as our
   * maps do, and what was taken from coordinates in a national grid or UTM before they became
   * floats, which would round them to centimetres or worse. */
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  size_t not_finite = 0;  ///< points left out, since a coordinate was no number
  size_t no_return = 0;   ///< points left out at 0 0 0: what lidars write for rays without a return
  /** Where the sensor stood, in the frame of the points: a PCD file's VIEWPOINT, else the origin.
   * None if that is far from the points: nobody has told. */
  std::optional<Eigen::Vector3d> viewpoint;
  /** The step to which large coordinates had been rounded by being floats before, metres; 0 if they
   * had not, or are not large. */
  double rounded_to_m = 0;
};

enum class CloudKind { kPcd, kPly };

/** Reads `x y z` of a PLY or PCD file, whichever its name ends in; other fields are skipped.
 * \throws std::runtime_error naming the file, and the line in its text, if it cannot be read, is
 *    damaged, or has no point with finite coordinates. */
CloudPoints readCloudPoints(const std::string& path);
/** \param file can be sought in; \param name of the file, for messages. */
CloudPoints readCloudPoints(std::unique_ptr<std::istream> file, CloudKind kind,
                            const std::string& name);

}  // namespace lamp
