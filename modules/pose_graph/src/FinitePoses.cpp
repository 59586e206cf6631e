#include "FinitePoses.h"

#include <stdexcept>

namespace lamp {

void checkFinite(const PoseGraph& graph, const std::vector<Pose3>& world_T_base) {
  for (size_t i = 0; i < world_T_base.size(); ++i) {
    if (isFinite(world_T_base[i])) continue;
    const KeyframeId id = graph.nodes()[i].id;
    throw std::runtime_error("optimizer: the pose of key node " + std::to_string(id.index) +
                             " of robot " + std::to_string(id.robot.value) +
                             " is not finite; give it a finite estimate before optimising");
  }
}

}  // namespace lamp
