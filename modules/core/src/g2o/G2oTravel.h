#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "g2o/G2oNodes.h"
#include "lamp/core/OdometryEdges.h"

namespace lamp {

/** How the robots of a file came from node to node. */
struct G2oTravel {
  std::vector<char> letters;  ///< of the robots, in the order of their first ids; 0 for plain ids
  std::vector<uint64_t> ids;  ///< of the nodes, robot by robot, in the order of travel
  std::set<const G2oLine*> odometry;
  OdometryRule rule;
};

/** \param edges those that count.
 * \throws std::runtime_error if the pairs that the user lists are no chains of the file's edges. */
G2oTravel travelOf(const G2oLines& file, const G2oNodes& nodes,
                   const std::vector<const G2oLine*>& edges, const OdometryEdges& choice);

}  // namespace lamp
