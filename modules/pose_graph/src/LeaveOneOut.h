#pragma once

#include <vector>

#include "LoopNeighbourhoods.h"

namespace lamp {

/** For each of some edges, the squared Mahalanobis distance of its measurement to what all other
 * edges say, to first order (Baarda, "A testing procedure for use in geodetic networks", 1968): by
 * so much the sum of squares falls without the edge. Its residual may be small though that is
 * large, where the others have given way.
 *
 * \param poses by place in PoseGraph::nodes(), then landmarks(): the optimum.
 * \param taking_part flags of all edges, with which it is one. \param edges which take part.
 * \return zeros if the normal equations cannot be factorised. */
std::vector<double> leaveOneOut2(const PoseGraph& graph, const std::vector<Pose3>& poses,
                                 const std::vector<bool>& taking_part,
                                 const std::vector<EdgeIndex>& edges);

/** Upper bounds of the same for loop closures, at little cost: what all others say is at least as
 * sure as what odometry says, or odometry and the nearest other loop. */
class LeaveOneOutBound {
 public:
  /** The graph must outlive it. */
  LeaveOneOutBound(const PoseGraph& graph, const std::vector<bool>& taking_part);

  /** Infinite where nothing so simple is known, and for edges of other types. */
  double distance2(EdgeIndex edge, const std::vector<Pose3>& poses) const;

 private:
  const PoseGraph& graph_;
  const OdometryChains chains_;
  LoopNeighbourhoods neighbourhoods_;
};

}  // namespace lamp
