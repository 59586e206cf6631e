#pragma once

#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** \throws std::runtime_error naming the first key node whose pose is not finite. */
void checkFinite(const PoseGraph& graph, const std::vector<Pose3>& poses);

}  // namespace lamp
