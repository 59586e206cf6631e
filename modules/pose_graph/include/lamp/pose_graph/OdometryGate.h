#pragma once

#include "lamp/pose_graph/OutlierRejection.h"

namespace lamp {

struct OdometryGateOptions {
  double inlier_probability = 0.9999;
  double max_scale = 100.0;

  void visit(OptionVisitor& v);
};

/** Rejects loop closures that odometry contradicts: by their squared Mahalanobis distance to the
 * relative pose that the odometry between their nodes gives, with the covariance of the chain
 * carried along by adjoints (Barfoot, Furgale, T-RO 2014, to first order). Between robots through
 * their priors, where both have one; loops across a gap of odometry pass.
 *
 * Odometry may be worse than it says: its covariances are first scaled, up to a limit and never
 * down, so that nearly as many loops fit it as with any scale, false ones not counted. If a tenth
 * of the loops, and not few, ask for much, the optimisation is to take it so, too. */
class OdometryGate : public OutlierRejection {
  DEFINE_MRPT_OBJECT(OdometryGate, lamp)

 public:
  explicit OdometryGate(const OdometryGateOptions& options = {}) : options_(options) {}

  void visit(OptionVisitor& options) override { options_.visit(options); }
  void reject(const PoseGraph& graph, std::vector<bool>& admitted) override;
  /** 1 if the loops do not say clearly that odometry is worse than stated. */
  double odometryScale() const override { return scale_; }

 private:
  OdometryGateOptions options_;
  double scale_ = 1.0;
};

}  // namespace lamp
