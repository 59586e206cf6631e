#pragma once

#include "lamp/core/KeyNodePacket.h"
#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Adds a key node to the graph, with the edge that ties it to its robot's previous one or, for the
 * first, to its start pose; at the pose that this edge gives it. */
void registerNode(const KeyNodePacket& packet, PoseGraph& graph);

}  // namespace lamp
