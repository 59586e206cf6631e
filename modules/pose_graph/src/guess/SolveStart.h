#pragma once

#include <vector>

#include "lamp/core/PoseGraph.h"
#include "lamp/pose_graph/Optimizer.h"

namespace lamp {

/** Where a solver starts. */
struct SolveStart {
  std::vector<Pose3> poses;    ///< by place in PoseGraph::nodes(), then landmarks()
  std::vector<bool> admitted;  ///< by edge
};

/** Places the landmarks as seen from key nodes at the given poses: at the median of the sightings,
 * or where the distances meet. Edges of no use are no longer admitted: those to landmarks that
 * nothing places, and those between robots, or a robot and the world, whose frames nothing admitted
 * relates.
 * \param world_T_base in the order of PoseGraph::nodes(). */
SolveStart completeStart(const PoseGraph& graph, std::vector<Pose3> world_T_base,
                         std::vector<bool> admitted);

/** The graph, with the flags as verdicts on the edges that may be rejected. */
PoseGraph judged(PoseGraph graph, const std::vector<bool>& admitted);

/** Stores the key nodes' and the landmarks' parts of a solution in the result. */
void splitSolution(const PoseGraph& graph, const SolveStart& start, std::vector<Pose3> solution,
                   OptimizationResult& result);

}  // namespace lamp
