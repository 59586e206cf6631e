#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace lamp {

/** What tells odometry from loop closures in a graph file, which does not say it. */
enum class OdometryRule {
  kAuto,      ///< ids, or what else chains the nodes if ids hardly do
  kIds,       ///< edges between successive ids, gaps or not
  kNext,      ///< edges between an id and id + 1
  kVertices,  ///< edges between successive VERTEX lines
  kEdges,     ///< edges in the order of the file, so that each node has two at most
  kListed,    ///< pairs of ids
};
const char* toString(OdometryRule rule);

struct OdometryEdges {
  OdometryRule rule = OdometryRule::kAuto;
  /** For kListed: pairs of ids, in either order. */
  std::vector<std::pair<uint64_t, uint64_t>> pairs;
};

/** \param text a rule's name, or the path of a file with a pair of ids in each line.
 *  \throws UsageError if it is neither; std::runtime_error naming file and line. */
OdometryEdges odometryEdgesFrom(const std::string& text);

}  // namespace lamp
