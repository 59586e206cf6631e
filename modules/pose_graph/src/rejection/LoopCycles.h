#pragma once

#include "rejection/OdometryChains.h"

namespace lamp {

/** A loop closure, turned so that it leads from the earlier chain, or key node, to the later. */
struct DirectedLoop {
  EdgeIndex edge;
  KeyNodeId from, to;
  RelativePose measured;
};

DirectedLoop directed(EdgeIndex index, const Edge& edge, bool planar);

/** How many key nodes apart two key nodes of one robot are. */
int nodesBetween(KeyNodeId a, KeyNodeId b);

/** From `a.from` to `a.to` by odometry, loop b and odometry. Both loops must join the same
 * chains. */
RelativePose otherWay(const DirectedLoop& a, const DirectedLoop& b, const OdometryChains& chains);

/** How far a cycle is from closing, and the covariance of that. */
struct Closure {
  Vector6d error;
  Matrix6d covariance;

  double distance2() const;
};

/** For the cycle of loop a, odometry, loop b and odometry. */
Closure cycle(const DirectedLoop& a, const DirectedLoop& b, const OdometryChains& chains);

}  // namespace lamp
