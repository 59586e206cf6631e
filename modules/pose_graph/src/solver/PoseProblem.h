#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lamp/core/PoseGraph.h"
#include "lamp/pose_graph/SolverOptions.h"

namespace lamp {

/** How one solve went. Costs are half the weighted sums of squared residuals. */
struct SolveSummary {
  bool usable = true;
  std::string termination;
  int iterations = 0;
  double initial_cost = 0;
  double final_cost = 0;
};

/** The least-squares problem of a pose graph, with a weight for each edge. It is solved repeatedly
 * with other weights and starts; edges of weight zero take no part. */
class PoseProblem {
 public:
  virtual ~PoseProblem() = default;

  /** Where the next solve starts. \param poses in the order of PoseGraph::nodes(), then
   *  landmarks(), of which only the positions count.
   * \throws std::runtime_error naming a node whose pose is not finite. */
  virtual void setPoses(const std::vector<Pose3>& poses) = 0;
  virtual std::vector<Pose3> poses() const = 0;
  /** \param weight factor of the edge's squared residual, at least 0. */
  virtual void setWeight(EdgeIndex edge, double weight) = 0;
  /** Squared Mahalanobis residual at poses(), without the weight. */
  virtual double chi2(EdgeIndex edge) const = 0;
  /** For each of some edges, the squared Mahalanobis distance of its measurement to what all other
   * edges say, to first order about poses(), an optimum (Baarda, "A testing procedure for use in
   * geodetic networks", 1968): by this much the sum of squares falls without the edge, or rises
   * with an edge that takes no part. It may be large although the edge's residual is small, because
   * the others have given way; and small although the residual of an edge that takes no part is
   * large, because they would. For edges that take no part, a lower bound if that is beyond any
   * threshold. Zeros if the normal equations are singular. */
  virtual std::vector<double> leaveOneOut2(const std::vector<EdgeIndex>& edges) = 0;
  /** Moves poses() to a minimum; leaves them alone if the summary is not usable. */
  virtual SolveSummary solve(const SolverOptions& options) = 0;
};

/** The problem of a graph that outlives it unchanged, for a solver of solverNames(). All edges have
 * weight 1 at first. \throws std::runtime_error as setPoses(). */
std::unique_ptr<PoseProblem> makePoseProblem(const std::string& solver, const PoseGraph& graph,
                                             const std::vector<Pose3>& poses);

}  // namespace lamp
