#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lamp/core/PoseGraph.h"
#include "lamp/core/UncertaintyQuery.h"

namespace lamp {

/** Covariances of poses at the graph's estimate, by the inverse of the normal equations' matrix,
 * of which only the blocks asked for are computed (from columns of the inverse Cholesky factor:
 * Kaess, Dellaert, "Covariance recovery from a square root information matrix for data
 * association", RAS 2009).
 *
 * Edges count with their weights; rejected ones do not. What no edge knows has a standard deviation
 * of up to 1000 m or rad. Of a planar graph only x, y, yaw are computed, the other axes get a
 * variance of 1e-6.
 *
 * Takes a snapshot: later changes of the graph are not seen. The first query factorises the matrix;
 * it throws std::runtime_error if rounding errors leave no positive definite one. Queries may run
 * in parallel. */
class MarginalCovariances : public UncertaintyQuery {
 public:
  explicit MarginalCovariances(const PoseGraph& graph);
  ~MarginalCovariances() override;

  /** Zero from a node to itself. \throws std::out_of_range if an id is not in the graph. */
  std::vector<std::optional<Matrix6d>> relativeCovariances(
      KeyNodeId from, const std::vector<KeyNodeId>& to) const override;

  /** Covariance of `world_T_base` in its tangent space; of a component that no prior reaches,
   * relative to its first key node. \throws std::out_of_range. */
  Matrix6d covariance(KeyNodeId id) const;

  /** The same of all nodes, in their order, for the price of a few factorisations. */
  std::vector<Matrix6d> covariances() const;

  /** Covariance of `world_p`, relative to the same; zero if nothing moves the landmark.
   * \throws std::out_of_range. */
  Eigen::Matrix3d landmarkCovariance(LandmarkIndex landmark) const;

 private:
  class Impl;
  template <class Space>
  class ImplOf;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace lamp
