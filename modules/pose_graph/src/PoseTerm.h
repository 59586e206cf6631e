#pragma once

#include <vector>

#include "PoseSpaces.h"
#include "lamp/core/PoseGraph.h"

namespace lamp {

/** An edge of the graph as the solvers see it: one term of the sum of squares. */
template <class Space>
struct PoseTerm {
  using Pose = typename Space::Pose;
  using Jacobian = typename Space::Jacobian;

  bool prior;
  size_t from, to;  ///< places in PoseGraph::nodes()
  Pose measured;
  Jacobian information;
  double weight = 1.0;

  /** Null pointers ask for no Jacobian. A prior has only `d_to`. */
  typename Space::Tangent error(const Pose& from_pose, const Pose& to_pose, Jacobian* d_from,
                                Jacobian* d_to) const {
    if (prior) return Space::priorError(measured, to_pose, d_to);
    return Space::relativeError(measured, from_pose, to_pose, d_from, d_to);
  }

  /** Squared Mahalanobis distance, without the weight. */
  double chi2(const Pose& from_pose, const Pose& to_pose) const {
    const typename Space::Tangent e = error(from_pose, to_pose, nullptr, nullptr);
    return e.dot(information * e);
  }
};

/** One term for each edge, in their order. */
template <class Space>
std::vector<PoseTerm<Space>> poseTerms(const PoseGraph& graph) {
  std::vector<PoseTerm<Space>> terms;
  for (const Edge& edge : graph.edges())
    terms.push_back({edge.type == EdgeType::kPrior, graph.place(edge.from), graph.place(edge.to),
                     Space::fromPose3(normalized(edge.from_T_to)),
                     Space::information(edge.information)});
  return terms;
}

}  // namespace lamp
