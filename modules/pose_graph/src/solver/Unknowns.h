#pragma once

#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Which poses of a graph a least-squares problem moves, and where they stand in its equations. */
struct Unknowns {
  /** By place in PoseGraph::nodes(), then landmarks(), in blocks; -1 for what is held. */
  std::vector<int> row;
  int size = 0;                ///< number of rows
  int first_landmark_row = 0;  ///< the rows of landmarks are the last ones
  /** Key nodes (places) at which a component's position and yaw are held, but not roll and pitch,
   * which gravity tells. */
  std::vector<size_t> level_anchors;
};

/** Held are gaugeAnchors(), fixed key nodes, and landmarks whose position is known or that no edge
 * reaches.
 * \param weights one for each edge; those of weight zero take no part. */
Unknowns findUnknowns(const PoseGraph& graph, const std::vector<double>& weights);

}  // namespace lamp
