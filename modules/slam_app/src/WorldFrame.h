#pragma once

#include <Eigen/Core>

#include "lamp/core/PoseGraph.h"
#include "lamp/slam_app/SlamConfig.h"

namespace lamp {

/** World coordinates of the origin of the local frame that a run works in: near the start poses, or
 * the known beacons where there are none, by wholeKilometres(). */
Eigen::Vector3d localOrigin(const SlamConfig& config);

/** The configuration with start poses and known beacons in the local frame. */
SlamConfig inLocalFrame(SlamConfig config, const Eigen::Vector3d& world_p_origin);

/** World coordinates of the origin of a component's frame: the local frame's if a start pose or a
 * known landmark ties the component to the world; else zero, since the frame is its own. */
Eigen::Vector3d originOf(const Component& component, const PoseGraph& local,
                         const Eigen::Vector3d& world_p_origin);

/** The graph with the poses and landmarks of each component moved by its originOf(). */
PoseGraph inWorldFrame(PoseGraph local, const Eigen::Vector3d& world_p_origin);

}  // namespace lamp
