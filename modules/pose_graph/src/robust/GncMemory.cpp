#include "robust/GncMemory.h"

#include <algorithm>

namespace lamp {

namespace {

bool sameMeasurement(const Edge& a, const Edge& b) {
  return a.type == b.type && a.pinned == b.pinned && a.from == b.from && a.to == b.to &&
         a.from_T_to.matrix() == b.from_T_to.matrix() && a.information == b.information &&
         a.landmark == b.landmark && a.from_p_sensor == b.from_p_sensor &&
         a.to_p_sensor == b.to_p_sensor;
}

}  // namespace

bool continues(const PoseGraph& graph, const GncMemory& memory) {
  return graph.nodes().size() >= memory.nodes.size() &&
         graph.edges().size() >= memory.edges.size() &&
         std::equal(memory.nodes.begin(), memory.nodes.end(), graph.nodes().begin(),
                    [](KeyNodeId id, const Node& node) { return id == node.id; }) &&
         std::equal(memory.edges.begin(), memory.edges.end(), graph.edges().begin(),
                    sameMeasurement);
}

std::vector<Pose3> continuedPoses(const PoseGraph& graph, const GncMemory& memory,
                                  const std::vector<Pose3>& guess) {
  std::vector<Pose3> poses = memory.poses;
  for (size_t i = poses.size(); i < guess.size(); ++i) {
    const KeyNodeId id = graph.nodes()[i].id;
    const KeyNodeId previous{id.robot, id.index - 1};
    const bool follows = id.index > 0 && graph.contains(previous) && graph.place(previous) < i;
    const size_t place = follows ? graph.place(previous) : i;
    poses.push_back(follows ? normalized(poses[place] * guess[place].inverse() * guess[i])
                            : guess[i]);
  }
  return poses;
}

GncMemory remember(const PoseGraph& graph, const std::vector<bool>& admitted,
                   const OptimizationResult& result) {
  GncMemory memory;
  for (const Node& node : graph.nodes()) memory.nodes.push_back(node.id);
  memory.edges = graph.edges();
  memory.admitted = admitted;
  memory.inlier.assign(graph.edges().size(), true);
  for (const LoopVerdict& loop : result.loops)
    memory.inlier[loop.edge] = loop.verdict == Verdict::kInlier;
  memory.poses = result.world_T_base;
  return memory;
}

}  // namespace lamp
