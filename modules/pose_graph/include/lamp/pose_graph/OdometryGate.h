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
 * their priors, where both have one; loops across a gap of odometry pass. What it
 * rejects tells how many false loops there are (Admission::false_loops).
 *
 * Odometry may be worse than it says: its covariances are first scaled, up to a limit and never
 * down, so that nearly as many loops fit it as with any scale, false ones not counted. If a tenth
 * of the loops, and not few, ask for much, the optimisation is to take it so, too. Loops that
 * neighbours bear out tell the scale, one for each pair of places, or all where those are few. With
 * a scale above 1 what is rejected waits for the solution (Admission::waiting). */
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
