#pragma once

#include "lamp/pose_graph/OutlierRejection.h"

namespace lamp {

struct OdometryGateOptions {
  double inlier_probability = 0.9999;
  double max_scale = 100.0;

  void visit(OptionVisitor& v);
};

/** Rejects loop closures that odometry contradicts, judged by their squared Mahalanobis distance to
 * the relative pose that odometry gives between their key nodes. Adjoints carry the covariance
 * along the chain (Barfoot, Furgale, T-RO 2014, to first order). Between robots the priors link the
 * chains, where both have one; loops across a gap in odometry pass. The number of loops rejected
 * tells how many false ones there are (Admission::false_loops).
 *
 * Odometry may be worse than it claims. So its covariances are first scaled up, within a limit, by
 * the least factor with which nearly as many loops fit as with any other, not counting those that
 * false loops would add by chance. If ten loops or more, and a tenth of them, call for a large
 * factor, the optimisation uses it, too. The factor is found from loops that their neighbours bear
 * out, one for each pair of places; where those are few, from all loops. With a factor above 1,
 * rejected loops wait for the solution (Admission::waiting). */
class OdometryGate : public OutlierRejection {
  DEFINE_MRPT_OBJECT(OdometryGate, lamp)

 public:
  explicit OdometryGate(const OdometryGateOptions& options = {}) : options_(options) {}

  void visit(OptionVisitor& options) override { options_.visit(options); }
  Admission reject(const PoseGraph& graph, Admission before) override;

 private:
  OdometryGateOptions options_;
};

}  // namespace lamp
