#pragma once

#include <optional>
#include <vector>

#include "lamp/pose_graph/Gnc.h"

namespace lamp {

/** Whether the graph is the remembered one, with nothing but nodes and edges added at the end. */
bool continues(const PoseGraph& graph, const GncMemory& memory);

/** Where a solve of the grown graph starts: the remembered poses, continued by odometry for new key
 * nodes. \param guess initialGuess() of the graph. */
std::vector<Pose3> continuedPoses(const PoseGraph& graph, const GncMemory& memory,
                                  const std::vector<Pose3>& guess);

/** What to remember of a usable result. */
GncMemory remember(const PoseGraph& graph, const std::vector<bool>& admitted,
                   const OptimizationResult& result);

}  // namespace lamp
