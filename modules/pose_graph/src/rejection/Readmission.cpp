#include "rejection/Readmission.h"

#include <map>

#include "lamp/core/ChiSquare.h"
#include "lamp/pose_graph/MarginalCovariances.h"
#include "rejection/PoseVolume.h"
#include "solver/Information.h"

namespace lamp {

namespace {

/** OdometryGate's default. */
constexpr double kInlierProbability = 0.9999;

/** A waiting loop compared with the solution. */
struct WaitingLoop {
  EdgeIndex edge;
  Vector6d error;
  Matrix6d covariance;  ///< of the loop, in the tangent space of the error
  double threshold;
  Pose3 from_T_to;  ///< of the solution

  /** Of the loop and the solution together. \param relative covariance of the solution's pose. */
  Matrix6d with(const Matrix6d& relative) const {
    const Matrix6d J = rightJacobianInverse(error);
    return J * relative * J.transpose() + covariance;
  }

  /** Holds whatever the correlation of both ends, and is cheap: the covariance of a difference is
   * at most twice the sum of both covariances. */
  bool tooFar(const Matrix6d& of_from, const Matrix6d& of_to) const {
    const Matrix6d Ad = adjoint(from_T_to.inverse());
    const Matrix6d most = 2.0 * (Ad * of_from * Ad.transpose() + of_to);
    return mahalanobis2(error, with(most)) > threshold;
  }
};

WaitingLoop waitingLoop(const PoseGraph& solved, EdgeIndex e) {
  const Edge& edge = solved.edges()[e];
  const bool planar = solved.planar();
  const Pose3 solution =
      solved.node(edge.from).world_T_base.inverse() * solved.node(edge.to).world_T_base;
  return {
      e, logSE3(edge.from_T_to.inverse() * solution), boundedCovariance(edge.information, planar),
      chiSquareQuantile(kInlierProbability, std::max(1, informationRank(edge.information, planar))),
      solution};
}

}  // namespace

std::vector<EdgeIndex> borneOut(const PoseGraph& graph, const OptimizationResult& result,
                                const Admission& admission) {
  std::vector<EdgeIndex> found;
  PoseGraph solved = graph;
  applyResult(result, solved);
  const PoseVolume volume(solved);
  const auto isChance = [&](EdgeIndex e, const Matrix6d& covariance) {
    return !admission.likely[e] && volume.chance(covariance) > admission.max_chance;
  };
  std::map<KeyNodeId, std::vector<WaitingLoop>> unsure;  // by their first key node
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    if (!admission.waiting[e]) continue;
    const WaitingLoop loop = waitingLoop(solved, e);
    if (mahalanobis2(loop.error, loop.covariance) <= loop.threshold &&
        !isChance(e, loop.covariance))
      found.push_back(e);
    else
      unsure[graph.edges()[e].from].push_back(loop);
  }
  if (unsure.empty()) return found;
  const MarginalCovariances marginals(solved);
  const std::vector<Matrix6d> of_node = marginals.covariances();
  for (auto& [from, loops] : unsure) {
    const Matrix6d& of_from = of_node[solved.place(from)];
    std::vector<KeyNodeId> to;
    std::vector<WaitingLoop> near;
    for (const WaitingLoop& loop : loops) {
      const KeyNodeId end = graph.edges()[loop.edge].to;
      if (loop.tooFar(of_from, of_node[solved.place(end)])) continue;
      near.push_back(loop);
      to.push_back(end);
    }
    if (to.empty()) continue;
    const auto covariances = marginals.relativeCovariances(from, to);
    for (size_t i = 0; i < near.size(); ++i) {
      if (!covariances[i]) continue;
      const Matrix6d both = near[i].with(*covariances[i]);
      if (mahalanobis2(near[i].error, both) <= near[i].threshold && !isChance(near[i].edge, both))
        found.push_back(near[i].edge);
    }
  }
  return found;
}

}  // namespace lamp
