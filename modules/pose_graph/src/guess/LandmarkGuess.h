#pragma once

#include <optional>
#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Where each of the graph's landmarks lies in the world, as seen from key nodes at the given
 * poses; none where the admitted edges do not tell.
 * \param world_T_base in the order of PoseGraph::nodes(). \param admitted by edge. */
std::vector<std::optional<Eigen::Vector3d>> landmarkGuess(const PoseGraph& graph,
                                                          const std::vector<Pose3>& world_T_base,
                                                          const std::vector<bool>& admitted);

}  // namespace lamp
