#include "SameHeading.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

IMPLEMENTS_MRPT_OBJECT(SameHeading, lamp::CandidateGenerator, lamp)

namespace lamp {

void SameHeadingOptions::visit(OptionVisitor& v) {
  v("radius_m", radius_m, "m", "search radius", kPositive);
  v("max_angle_deg", max_angle_deg, "deg", "largest angle between the two headings", {0, 180});
  v("min_index_gap", min_index_gap, "key nodes",
    "key nodes of one robot that are nearer in sequence are no loop", {1});
  v("max_per_robot", max_per_robot, "", "candidates for a key node and each robot, nearest first",
    {1});
}

bool SameHeading::maybeLoop(const Node& current, const Node& other) const {
  if (other.id.robot == current.id.robot &&
      std::abs(int64_t{other.id.index} - int64_t{current.id.index}) < options_.min_index_gap)
    return false;
  const Pose3 current_T_other = current.world_T_base.inverse() * other.world_T_base;
  return current_T_other.translation().norm() <= options_.radius_m &&
         rotationAngle(current_T_other) <= options_.max_angle_deg * M_PI / 180;
}

std::vector<LoopClosureCandidate> SameHeading::propose(const PoseGraph& graph,
                                                       KeyNodeId current) {
  const Node& here = graph.node(current);
  std::vector<LoopClosureCandidate> candidates;
  for (const RobotId robot : graph.robots()) {
    if (!graph.shareFrame(robot, current.robot)) continue;  // "near" would mean nothing
    std::vector<std::pair<double, KeyNodeId>> near;
    for (const KeyNodeId id : graph.robotNodes(robot)) {
      const Node& other = graph.node(id);
      if (!maybeLoop(here, other)) continue;
      const Eigen::Vector3d way =
          other.world_T_base.translation() - here.world_T_base.translation();
      near.emplace_back(way.norm(), id);
    }
    std::sort(near.begin(), near.end());
    near.resize(std::min(near.size(), static_cast<size_t>(options_.max_per_robot)));
    for (const auto& [distance, other] : near) {
      LoopClosureCandidate candidate{other, current, getLoggerName()};
      candidate.why = "looks the same way";
      if (graph.place(candidate.from) > graph.place(candidate.to))  // `from` is the older one
        std::swap(candidate.from, candidate.to);
      candidates.push_back(candidate);
    }
  }
  return candidates;
}

}  // namespace lamp
