#pragma once

#include <optional>
#include <vector>

#include "lamp/pose_graph/Gnc.h"

namespace lamp {

/** Whether the graph is the remembered one with nothing but further nodes and edges. */
bool continues(const PoseGraph& graph, const GncMemory& memory);

/** Where a solve of the grown graph starts: the remembered poses, and new key nodes where odometry
 * puts them behind those. \param guess initialGuess() of the graph. */
std::vector<Pose3> continuedPoses(const PoseGraph& graph, const GncMemory& memory,
                                  const std::vector<Pose3>& guess);

/** What there is to remember of a usable result. */
GncMemory remember(const PoseGraph& graph, const std::vector<bool>& admitted,
                   const OptimizationResult& result);

}  // namespace lamp
