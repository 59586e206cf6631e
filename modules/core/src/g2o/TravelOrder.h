#pragma once

#include <cstddef>
#include <vector>

#include "lamp/core/OdometryEdges.h"

namespace lamp {

/** An edge between two nodes of one robot, by their numbers from 0. */
struct NodePair {
  size_t from, to;
};

/** What the lines of a graph file tell of its nodes. */
struct NodeSequences {
  std::vector<uint64_t> ids;     ///< of the nodes, ascending, robot by robot
  std::vector<size_t> vertices;  ///< the nodes in the order of VERTEX lines, then those without
  std::vector<NodePair> pairs;   ///< in the order of the file
};

/** The nodes in the order in which the robots came to them, and the pairs that are odometry: each
 * joins two nodes that follow one another, and no two of them the same nodes. */
struct TravelOrder {
  OdometryRule rule;
  std::vector<size_t> nodes;
  std::vector<size_t> odometry;  ///< places in NodeSequences::pairs, ascending
};

/** By a rule, of which kAuto takes ids, unless they chain less than a quarter of the nodes that the
 * VERTEX lines, or a path along edges, chain. Nodes that no pair reaches stand behind the others.
 * \param rule not kListed. */
TravelOrder travelOrder(const NodeSequences& file, OdometryRule rule);

/** Along pairs that are known to be odometry.
 * \param listed places in NodeSequences::pairs, no node in more than two, and no cycle. */
TravelOrder travelOrder(const NodeSequences& file, const std::vector<size_t>& listed);

}  // namespace lamp
