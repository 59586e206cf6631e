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

/** Places the landmarks as key nodes at such poses see them: the median of the sightings, or where
 * the distances meet. Edges that cannot help are not admitted any more: of landmarks that nothing
 * places, and between robots, or a robot and the world, whose frames nothing admitted relates.
 * \param world_T_base in the order of PoseGraph::nodes(). */
SolveStart completeStart(const PoseGraph& graph, std::vector<Pose3> world_T_base,
                         std::vector<bool> admitted);

/** The graph with its edges that may be rejected judged as the flags say. */
PoseGraph judged(PoseGraph graph, const std::vector<bool>& admitted);

/** The key nodes' part and the landmarks' part of a solution. */
void splitSolution(const PoseGraph& graph, const SolveStart& start, std::vector<Pose3> solution,
                   OptimizationResult& result);

}  // namespace lamp
