#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "lamp/scans/LocalMap.h"

namespace lamp {

/** A surveyed map, for robots to be localised in. */
struct Survey {
  std::string path;
  std::vector<Eigen::Vector3f> points;  ///< world coordinates less the origin
  /** What to add for world coordinates, metres. */
  Eigen::Vector3d world_p_origin = Eigen::Vector3d::Zero();
  std::unique_ptr<LocalMap> map;  ///< of the points
};

/** Reads a PLY or PCD file.
 * \throws std::runtime_error naming the file, and what to do, if no scan could be registered to it.
 */
Survey readSurvey(const std::string& path);

/** How far a place lies outside the box around the survey's points, metres; 0 inside. */
double distanceFrom(const Survey& survey, const Eigen::Vector3d& survey_p);

}  // namespace lamp
