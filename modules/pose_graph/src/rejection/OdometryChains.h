#pragma once

#include <optional>
#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** A relative pose, and its covariance in the tangent space there. */
struct RelativePose {
  Pose3 a_T_b;
  Matrix6d covariance;
};

/** What odometry alone says about the relative pose of two key nodes: O(n) to set up, O(1) per
 * pair.
 *
 * The errors of a chain's edges, each carried to the chain's first node by the adjoint, are summed
 * along the chain; the covariance of a piece is the difference of two sums, carried to its end. A
 * chain ends where an odometry edge is missing. Two chains are related through the world if each
 * has a fixed key node or a prior; of several, fixed key nodes come before priors, and the first
 * counts. */
class OdometryChains {
 public:
  explicit OdometryChains(const PoseGraph& graph);

  /** None if neither odometry nor priors relate the two.
   * \param scale factor on all covariances of odometry. */
  std::optional<RelativePose> between(KeyNodeId a, KeyNodeId b, double scale = 1.0) const;
  /** From the first key node of its chain to a key node. */
  RelativePose fromFirst(KeyNodeId id) const;
  /** Only the pose of that. */
  const Pose3& poseFromFirst(KeyNodeId id) const { return links_[graph_.place(id)].first_T_node; }
  int size() const { return static_cast<int>(priors_.size()); }
  KeyNodeId first(int chain) const { return first_[chain]; }
  bool hasPrior(int chain) const { return priors_[chain].has_value(); }
  /** From the world to the chain's first key node; the chain must have a prior. */
  RelativePose prior(int chain) const {
    return {priors_[chain]->world_T_first, priors_[chain]->covariance};
  }
  /** The number of a key node's chain. */
  int chain(KeyNodeId id) const { return links_[graph_.place(id)].chain; }

 private:
  struct Link {
    int chain = -1;
    Pose3 first_T_node = Pose3::Identity();
    Matrix6d covariance = Matrix6d::Zero();  ///< summed, in the tangent space at the first node
  };
  struct Prior {
    Pose3 world_T_first;
    Matrix6d covariance;  ///< in the tangent space at the first node
  };

  void follow(RobotId robot);
  RelativePose withinChain(const Link& a, const Link& b, double scale) const;
  RelativePose throughWorld(const Link& a, const Link& b, double scale) const;

  const PoseGraph& graph_;
  std::vector<Link> links_;                   ///< by place in PoseGraph::nodes()
  std::vector<std::optional<Prior>> priors_;  ///< by chain
  std::vector<KeyNodeId> first_;              ///< by chain
};

}  // namespace lamp
