#include "lamp/evaluation/OdometryEdges.h"

#include <utility>

#include "G2oEdges.h"
#include "lamp/evaluation/LedgerLoops.h"

namespace lamp::evaluation {

CovarianceScore evaluateOdometryEdges(const RunFiles& run, const TruthFolder& truth) {
  const std::vector<LedgerNode> nodes = readKeyNodes(run.folder.graphIds());
  const G2oEdges edges = readG2oEdges(run.folder.graphG2o());
  std::vector<ClaimedPose> poses;
  for (const RunFiles::Robot& robot : run.robots) {
    if (!truth.has(robot.name)) continue;
    const TrueTrajectory path(readTum(truth.trajectory(robot.name)), robot.planar);
    const LedgerNode* previous = nullptr;
    for (const LedgerNode& node : nodes) {
      if (node.robot != robot.name) continue;
      const LedgerNode* const from = std::exchange(previous, &node);
      if (!from) continue;
      const auto found = edges.find({from->graph_id, node.graph_id});
      const auto begin = path.at(from->stamp), end = path.at(node.stamp);
      if (found == edges.end() || !begin || !end) continue;
      // Loop closures between neighbours come after the edge that made the key node.
      const G2oEdge& edge = found->second.front();
      poses.push_back({(begin->inverse() * *end).inverse() * edge.from_T_to, edge.information});
    }
  }
  return scoreCovariances(poses);
}

}  // namespace lamp::evaluation
