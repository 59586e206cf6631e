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

/** How many key nodes apart two of one robot are. */
int nodesBetween(KeyNodeId a, KeyNodeId b);

/** From `a.from` to `a.to` by odometry, loop b, and odometry. Both must join the same chains. */
RelativePose otherWay(const DirectedLoop& a, const DirectedLoop& b, const OdometryChains& chains);

/** How far a cycle, or loop and odometry, are from closing, and how far they may be. */
struct Closure {
  Vector6d error;
  Matrix6d covariance;

  double distance2() const;
};

/** Of loop a, odometry, loop b, odometry. */
Closure cycle(const DirectedLoop& a, const DirectedLoop& b, const OdometryChains& chains);

}  // namespace lamp
