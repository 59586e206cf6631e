#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lamp/core/OdometryEdges.h"
#include "lamp/core/PoseGraph.h"

namespace lamp {

/** What the information matrices of a file can mean. */
enum class InformationKind {
  kStated,    ///< they differ: somebody has measured something
  kConstant,  ///< all relative poses have the same one
  kIdentity,  ///< all are the identity: the program that wrote the file did not know any
};
const char* toString(InformationKind kind);

/** A pose graph as g2o files hold them. */
struct G2oGraph {
  PoseGraph graph;
  std::vector<uint64_t> ids;                   ///< in the file, in the order of PoseGraph::nodes()
  std::vector<char> letters;                   ///< of each RobotId; 0 where ids are no symbols
  std::map<std::string, size_t> skipped;       ///< lines with a tag that we do not know, by tag
  OdometryRule odometry = OdometryRule::kIds;  ///< which rule told odometry; not kAuto
  InformationKind information = InformationKind::kStated;
  std::vector<std::string> notes;  ///< what a user should know of how the file was taken

  /** How the file names a node: its id, or letter and index of a symbol. */
  std::string name(KeyNodeId id) const;
};

/** Reads the lines that g2o's own programs, GTSAM, RTAB-Map and SE-Sync write:
 *
 * - VERTEX_SE2, VERTEX_SE3:QUAT, EDGE_SE2, EDGE_SE3:QUAT, and EDGE_SE2_SWITCHABLE,
 *   EDGE_SE3_SWITCHABLE without their switches, since the back end has its own;
 * - FIX, of any number of ids: the node, or landmark, stays at its VERTEX (Node::fixed);
 * - absolute poses and positions as priors: EDGE_PRIOR_SE2, EDGE_SE2_PRIOR, EDGE_SE3_PRIOR;
 *   EDGE_PRIOR_SE2_XY, EDGE_POINTXYZ_PRIOR, EDGE_SE3_PRIOR_XYZ;
 * - landmarks, which are named by their ids: VERTEX_XY, VERTEX_TRACKXYZ, EDGE_SE2_XY,
 *   EDGE_SE3_TRACKXYZ; PARAMS_SE3OFFSET, of which number 0 is the identity if the file has none.
 *
 * A node without a VERTEX line starts where edges from nodes with one put it, or, if there is none
 * at all, from the first node at the origin. Ids have up to 64 bits. Those with a letter in the top
 * byte are GTSAM's symbols: each letter is one robot; all others are one robot's. Indices of key
 * nodes count the robot's nodes in the order in which odometry chains them, which follows from the
 * file (OdometryRule). Edges without any information are left out; information that is indefinite only by
 * rounding is mended; the notes say so, and how many edges repeat others word for word.
 * \param name of the text in messages.
 * \throws std::runtime_error naming the line, and the edge where there is one: for words that are
 * no numbers, numbers that are not finite, too few or too many; for an edge from a node to itself;
 * for an information matrix that is not positive semi-definite; for a node with two poses, or fixed
 * without one; for SE2 mixed with SE3; for listed odometry that is no chain of the file's edges. */
G2oGraph g2oFromText(const std::string& text, const std::string& name,
                     const OdometryEdges& odometry = {});

/** The graph with the file's ids; as lamp::toG2o(const PoseGraph&), and with priors, landmarks that
 * have a place, and FIX of the nodes that are fixed. A component without prior or fixed node has
 * its first one fixed. */
std::string toG2o(const G2oGraph& g2o);

/** \throws std::runtime_error also if the file cannot be read. */
G2oGraph readG2oFile(const std::string& path, const OdometryEdges& odometry = {});

}  // namespace lamp
