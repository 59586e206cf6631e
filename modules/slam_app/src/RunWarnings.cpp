#include "RunWarnings.h"

#include <algorithm>

#include "lamp/base_station/LoopCounts.h"

namespace lamp {

bool planarRobotsAreUnrelated(const PoseGraph& graph) {
  std::vector<RobotId> in_plane;
  for (const RobotId robot : graph.robots())
    if (graph.node(graph.robotNodes(robot).front()).planar) in_plane.push_back(robot);
  return std::any_of(in_plane.begin(), in_plane.end(),
                     [&](RobotId robot) { return !graph.shareFrame(in_plane.front(), robot); });
}

std::vector<std::string> runWarnings(const BaseStation& base) {
  std::vector<std::string> warnings;
  // A back end that hardly believes any loop closure has got wrong ones, or wrong odometry.
  const KeptLoops loops = keptLoops(base.graph(), base.lastReport().frames);
  if (base.optimizations() > 0 && loops.tooFew())
    warnings.push_back(
        "the back end kept only " + std::to_string(loops.kept) + " of " +
        std::to_string(loops.loops) +
        " verified loop closures: the map is hardly better than odometry. Most loop closures are "
        "wrong, or odometry is much worse than its covariances state (docs/pose_graph.md)");
  if (planarRobotsAreUnrelated(base.graph()))
    warnings.push_back(
        "robots with 2D lasers are not joined unless their start poses are known: scans in the "
        "plane are matched only near a guess. State start_pose in their [robot.NAME] sections");
  return warnings;
}

}  // namespace lamp
