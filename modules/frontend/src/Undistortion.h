#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "lamp/core/Geometry.h"

namespace lamp {

/** Moves each point by the pose that belongs to its time. Between a few moments of the sweep that
 * pose is taken to change evenly.
 * \param time of each point, seconds. \param pose_at of a time within these. */
void undistort(const std::vector<float>& time, const std::function<Pose3(double time)>& pose_at,
               std::vector<Eigen::Vector3f>& points);

}  // namespace lamp
