#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "lamp/core/PoseGraph.h"
#include "lamp/core/UncertaintyQuery.h"

namespace lamp {

/** Relative covariances compounded along the best single path through the graph.
 *
 * The path (Dijkstra) minimises the summed edge costs: the trace of the translation covariance plus
 * that of the rotation covariance at a lever arm of 10 m. It runs over odometry, over loops that
 * are not rejected and have a weight, and over the world, which priors reach: so robots with start
 * priors are related before any loop joins them.
 *
 * For independent edges this is an upper bound of the true relative covariance, to first order:
 * further paths can only add information. Edges with a singular information matrix bound nothing
 * and are not walked. Of a planar graph only x, y, yaw of the information count; the other axes get
 * a small variance (1e-6 an edge) that keeps the result invertible.
 *
 * Takes a snapshot: later changes of the graph are not seen. Queries may run in parallel. */
class ShortestPathUncertainty : public UncertaintyQuery {
 public:
  explicit ShortestPathUncertainty(const PoseGraph& graph);

  /** One search for all targets. Zero covariance from a node to itself.
   * \throws std::out_of_range if an id is not in the graph. */
  std::vector<std::optional<Matrix6d>> relativeCovariances(
      KeyframeId from, const std::vector<KeyframeId>& to) const override;

 private:
  /** A way from one vertex to the next along an edge. */
  struct Link {
    size_t to;
    size_t edge;  ///< place in covariances_
    bool backward;
    double cost;
  };

  void addEdge(size_t from, size_t to, const Matrix6d& covariance);
  Matrix6d extend(const Matrix6d& covariance, size_t at, const Link& link) const;

  std::unordered_map<KeyframeId, size_t> vertex_;
  std::vector<Pose3> world_T_vertex_;  ///< the key nodes, then the world itself
  std::vector<std::vector<Link>> links_;
  std::vector<Matrix6d> covariances_;  ///< of from_T_to, in its tangent space
};

}  // namespace lamp
