#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "lamp/core/Geometry.h"

namespace lamp {

struct PicturedCloud {
  std::string name;
  std::vector<Eigen::Vector3f> points;  ///< in the cloud's own frame, metres, finite
};

/** Two clouds, and what their registration found. */
struct RegistrationPicture {
  PicturedCloud source, target;
  std::optional<Pose3> target_T_source;  ///< none if nothing was found
  bool accepted = false;
  std::string verdict;  ///< in words
};

/** Writes a PNG: in the left column both clouds as they are, each in its own frame; in the right
 * one the source where the registration puts it. From above (+x to the right, +y up), and below
 * that from the side (+x to the right, +z up), all at one scale. \throws std::runtime_error naming
 * the path. */
void writeRegistrationPicture(const std::string& path, const RegistrationPicture& picture);

}  // namespace lamp
