#include "solver/FinitePoses.h"

#include <stdexcept>

namespace lamp {

void checkFinite(const PoseGraph& graph, const std::vector<Pose3>& poses) {
  for (size_t i = 0; i < poses.size(); ++i) {
    if (isFinite(poses[i])) continue;
    if (i >= graph.nodes().size())
      throw std::runtime_error("optimizer: the position of landmark '" +
                               graph.landmarks()[i - graph.nodes().size()].name +
                               "' is not finite");
    const KeyNodeId id = graph.nodes()[i].id;
    throw std::runtime_error("optimizer: the pose of key node " + std::to_string(id.index) +
                             " of robot " + std::to_string(id.robot.value) +
                             " is not finite; give it a finite estimate before optimising");
  }
}

}  // namespace lamp
