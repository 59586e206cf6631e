#pragma once

#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Poses along trees of odometry and loop closures that are not rejected: each key node stands
 * where the first of its neighbours puts it, in a breadth-first search from those that are placed.
 */
class TreeLayout {
 public:
  explicit TreeLayout(const PoseGraph& graph);

  /** \param node its place in PoseGraph::nodes(). */
  void place(size_t node, const Pose3& world_T_base);
  bool placed(size_t node) const { return placed_[node]; }
  /** Places all that edges join to the nodes placed since the last call. */
  void spread();

  /** `world_T_base` in the order of PoseGraph::nodes(); the identity of nodes never placed. */
  const std::vector<Pose3>& poses() const { return poses_; }

 private:
  struct Step {
    size_t to;
    Pose3 at_T_to;
  };

  std::vector<std::vector<Step>> steps_;
  std::vector<size_t> reached_;  ///< whose neighbours are to be placed
  std::vector<bool> placed_;
  std::vector<Pose3> poses_;
};

}  // namespace lamp
