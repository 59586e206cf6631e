#pragma once

#include "lamp/pose_graph/Optimizer.h"

namespace lamp {

/** Limits of one run of Levenberg-Marquardt. */
struct LmOptions {
  int max_iterations = 100;
  double function_tolerance = 1e-9;
  double initial_trust_region_radius = 1e12;

  void visit(OptionVisitor& v);
};

/** Levenberg-Marquardt (Ceres) over odometry, priors and all loop closures that are not rejected.
 *
 * Starts from the current estimates of the nodes. Loops that come in as kOutlier take no part and
 * stay outliers; all others come out as inliers of weight 1. Priors hold the components that they
 * reach; each other component is held at its first key node. A planar graph is solved in x, y, yaw.
 */
class Lm : public Optimizer {
  DEFINE_MRPT_OBJECT(Lm, lamp)

 public:
  explicit Lm(const LmOptions& options = {}) : options_(options) {}

  void visit(OptionVisitor& options) override { options_.visit(options); }
  /** \throws std::runtime_error if the estimate of a node is not finite. */
  OptimizationResult optimize(const PoseGraph& graph) override;

 private:
  LmOptions options_;
};

}  // namespace lamp
