#pragma once

#include <string>
#include <vector>

#include "lamp/core/KeyNodePacket.h"

namespace lamp::test {

/** Root mean square of the position errors, with the first poses laid onto each other.
 *  \throws std::runtime_error if a pose of `estimate` has no true one at its stamp. */
double ateFromFirst(const std::vector<StampedPose>& estimate,
                    const std::vector<StampedPose>& truth);

/** Number of cubes with a point in them. */
size_t occupiedCells(const std::vector<Eigen::Vector3f>& points, double edge_m);

}  // namespace lamp::test
