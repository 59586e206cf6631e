#pragma once

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Roll and pitch of a key node, from the direction of gravity.
 * \param base_up what points up, in the key node's frame; any length but zero.
 * \param sigma_rad standard deviation about each level axis. */
Edge gravityEdge(KeyNodeId id, const Eigen::Vector3d& base_up, double sigma_rad);

/** A landmark whose position is measured in the key node's frame. */
Edge positionEdge(KeyNodeId id, LandmarkIndex landmark, const Eigen::Vector3d& from_p_landmark,
                  const Eigen::Matrix3d& covariance);

/** A landmark seen by a sensor that measures direction and distance.
 * \param from_p_sensor, from_p_landmark in the key node's frame, apart from each other.
 * \param sigma_rad of the direction, each way; none if the direction is not measured.
 * \param sigma_m of the distance; none if it is not measured, so that only the direction counts. */
Edge bearingRangeEdge(KeyNodeId id, LandmarkIndex landmark, const Eigen::Vector3d& from_p_sensor,
                      const Eigen::Vector3d& from_p_landmark, std::optional<double> sigma_rad,
                      std::optional<double> sigma_m);

/** Distance between an antenna at `from_p_sensor` and a landmark. */
Edge rangeEdge(KeyNodeId id, LandmarkIndex landmark, const Eigen::Vector3d& from_p_sensor,
               double range_m, double sigma_m);

/** Distance between the antennas of two robots. */
Edge robotRangeEdge(KeyNodeId from, const Eigen::Vector3d& from_p_sensor, KeyNodeId to,
                    const Eigen::Vector3d& to_p_sensor, double range_m, double sigma_m);

}  // namespace lamp
