#include "guess/FixedNodes.h"

namespace lamp {

namespace {

/** A chain of odometry with fixed key nodes. */
class FixedChain {
 public:
  /** \param nodes of the chain, in order. */
  FixedChain(const PoseGraph& graph, const OdometryChains& chains,
             const std::vector<KeyNodeId>& nodes)
      : graph_(graph), chains_(chains), nodes_(nodes) {
    for (size_t k = 0; k < nodes.size(); ++k)
      if (graph.node(nodes[k]).fixed) fixed_.push_back(k);
  }

  void layOut(std::vector<Pose3>& poses) const {
    if (fixed_.empty()) return;
    size_t before = 0;  // in fixed_: the last one up to node k, else the first
    for (size_t k = 0; k < nodes_.size(); ++k) {
      if (before + 1 < fixed_.size() && fixed_[before + 1] <= k) ++before;
      Pose3 pose = seenFrom(fixed_[before], k);
      if (before + 1 < fixed_.size() && k > fixed_[before])
        pose = bent(pose, k, fixed_[before], fixed_[before + 1]);
      poses[graph_.place(nodes_[k])] = pose;
    }
  }

 private:
  const Pose3& known(size_t k) const { return graph_.node(nodes_[k]).world_T_base; }

  Pose3 seenFrom(size_t fixed, size_t k) const {
    if (k == fixed) return known(fixed);
    return normalized(known(fixed) * chains_.poseFromFirst(nodes_[fixed]).inverse() *
                      chains_.poseFromFirst(nodes_[k]));
  }

  /** A pose seen from `begin`, corrected by its share of the misfit at `end`. */
  Pose3 bent(const Pose3& pose, size_t k, size_t begin, size_t end) const {
    const Pose3 arrived = seenFrom(begin, end);
    const double ratio = static_cast<double>(k - begin) / static_cast<double>(end - begin);
    const Eigen::Quaterniond missing(known(end).linear() * arrived.linear().transpose());
    Pose3 result = Pose3::Identity();
    result.linear() =
        (Eigen::Quaterniond::Identity().slerp(ratio, missing) * Eigen::Quaterniond(pose.linear()))
            .toRotationMatrix();
    result.translation() =
        pose.translation() + ratio * (known(end).translation() - arrived.translation());
    return result;
  }

  const PoseGraph& graph_;
  const OdometryChains& chains_;
  const std::vector<KeyNodeId>& nodes_;
  std::vector<size_t> fixed_;  ///< places in nodes_
};

}  // namespace

void bendToFixedNodes(const PoseGraph& graph, const OdometryChains& chains,
                      std::vector<Pose3>& poses) {
  std::vector<std::vector<KeyNodeId>> nodes(static_cast<size_t>(chains.size()));
  for (const RobotId robot : graph.robots())
    for (const KeyNodeId id : graph.robotNodes(robot)) nodes[chains.chain(id)].push_back(id);
  for (const std::vector<KeyNodeId>& chain : nodes) FixedChain(graph, chains, chain).layOut(poses);
}

}  // namespace lamp
