#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lamp/core/PoseGraph.h"
#include "lamp/core/UncertaintyQuery.h"

namespace lamp {

/** Covariances of poses at the graph's estimate, from the inverse of the normal equations' matrix.
 * Only the blocks asked for are computed (from columns of the inverse Cholesky factor: Kaess,
 * Dellaert, "Covariance recovery from a square root information matrix for data association", RAS
 * 2009).
 *
 * Edges count with their weights; rejected ones do not. Directions that no edge measures get a
 * standard deviation of up to 1000 m or rad. In a planar graph only x, y and yaw are computed; the
 * other axes get a variance of 1e-6.
 *
 * Takes a snapshot: later changes to the graph are not seen. The first query factorises the matrix,
 * and throws std::runtime_error if rounding errors leave it not positive definite. Queries may run
 * in parallel. */
class MarginalCovariances : public UncertaintyQuery {
 public:
  explicit MarginalCovariances(const PoseGraph& graph);
  ~MarginalCovariances() override;

  /** Zero from a node to itself. \throws std::out_of_range if an id is not in the graph. */
  std::vector<std::optional<Matrix6d>> relativeCovariances(
      KeyNodeId from, const std::vector<KeyNodeId>& to) const override;

  /** Covariance of `world_T_base` in its tangent space; in a component that no prior reaches,
   * relative to the component's first key node. \throws std::out_of_range. */
  Matrix6d covariance(KeyNodeId id) const;

  /** The same for all nodes, in their order, at the cost of a few factorisations. */
  std::vector<Matrix6d> covariances() const;

  /** Covariance of the landmark's `world_p`, likewise; zero if its position is known or no edge
   * reaches it.
   * \throws std::out_of_range. */
  Eigen::Matrix3d landmarkCovariance(LandmarkIndex landmark) const;

 private:
  class Impl;
  template <class Space>
  class ImplOf;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace lamp
