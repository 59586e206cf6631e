#pragma once

#include <vector>

#include "lamp/core/PoseGraph.h"

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

}  // namespace lamp
