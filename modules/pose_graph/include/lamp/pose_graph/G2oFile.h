#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** A pose graph as g2o files hold them. */
struct G2oGraph {
  PoseGraph graph;
  std::vector<uint64_t> ids;              ///< in the file, in the order of PoseGraph::nodes()
  std::vector<char> letters;              ///< of each RobotId; 0 where ids are no symbols
  std::map<std::string, size_t> skipped;  ///< lines with a tag that we do not know, by tag

  /** How the file names a node: its id, or letter and index of a symbol. */
  std::string name(KeyNodeId id) const;
};

/** Reads EDGE_SE2, EDGE_SE3:QUAT, VERTEX_SE2 and VERTEX_SE3:QUAT; landmarks, which are named by
 * their ids: EDGE_SE2_XY, EDGE_SE3_TRACKXYZ with PARAMS_SE3OFFSET, VERTEX_XY, VERTEX_TRACKXYZ; FIX
 * is taken as read, since the first key node of each component is held anyway.
 *
 * VERTEX lines are not needed: without one, a node starts where odometry puts it. Ids have up to 64
 * bits. Those with a letter in the top byte are GTSAM's symbols: each letter is one robot; all
 * others are one robot's. The first edge between two successive ids of one robot is odometry, all
 * others are loop closures. Of each robot that no other edge joins the first node stays where it
 * is.
 * \param name of the text in messages.
 * \throws std::runtime_error naming the line, and the edge where there is one: for numbers that are
 * none, that are not finite, or too few or many; for an edge from a node to itself; for an
 * information matrix that is not positive semi-definite; for SE2 mixed with SE3. */
G2oGraph g2oFromText(const std::string& text, const std::string& name);

/** lamp::toG2o() with the file's ids, and the landmarks that have a place. */
std::string toG2o(const G2oGraph& g2o);

/** \throws std::runtime_error also if the file cannot be read. */
G2oGraph readG2oFile(const std::string& path);

}  // namespace lamp
