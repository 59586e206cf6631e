#pragma once

#include "lamp/pose_graph/OutlierRejection.h"

namespace lamp {

struct ChanceAgreementOptions {
  double max_chance = 0.03;
  int partner_nodes = 20;

  void visit(OptionVisitor& v);
};

/** Holds back loop closures whose agreement with odometry and with one another may be chance.
 *
 * Where odometry hardly knows how two key nodes lie, it agrees with nearly any loop closure between
 * them, and so does an optimisation if no other loop contradicts it. So two chances are computed
 * for each loop: p, that a false one, its relative pose uniform over the map's extent, falls within
 * the ellipsoid that odometry allows (1 where nothing relates its key nodes); and λ, the sum over
 * the k nearest loops (both ends within `partner_nodes` along odometry) of the chances that a false
 * one closes the cycle with each. A loop with which s of the k agree is admitted if, for some k, p
 * · k · min(1, λ)^s is so small that chance does not explain the agreement (the a-contrario test of
 * Desolneux, Moisan, Morel, "From Gestalt Theory to Image Analysis", 2008, to first order). The
 * limit is such that fewer than one of Admission::false_loops is expected to pass; where odometry
 * can judge no loop, it is `max_chance`.
 *
 * The others wait for the solution without them (Admission::waiting). */
class ChanceAgreement : public OutlierRejection {
  DEFINE_MRPT_OBJECT(ChanceAgreement, lamp)

 public:
  explicit ChanceAgreement(const ChanceAgreementOptions& options = {}) : options_(options) {}

  void visit(OptionVisitor& options) override { options_.visit(options); }
  Admission reject(const PoseGraph& graph, Admission before) override;

 private:
  ChanceAgreementOptions options_;
};

}  // namespace lamp
