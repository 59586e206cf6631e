#pragma once

#include "lamp/pose_graph/OutlierRejection.h"

namespace lamp {

struct ChanceAgreementOptions {
  double max_chance = 0.03;
  int partner_nodes = 20;

  void visit(OptionVisitor& v);
};

/** Lets loop closures wait whose agreement with odometry and with each other may be chance.
 *
 * Where odometry hardly knows how two key nodes lie, it agrees with nearly any loop closure between
 * them, and so does an optimisation if no other loop contradicts it. For each loop this is
 * computed: the chance p that a false one, its relative pose uniform over the map's extent, lies in
 * the ellipsoid that odometry allows (1 where nothing relates its key nodes); and for the k loops
 * next to it (both ends within `partner_nodes` along odometry) the sum λ of the chances that a
 * false one closes the cycle with it. A loop that s of them agree with is admitted if for some k p
 * · k · min(1, λ)^s is small enough: if chance does not explain what is seen (the a-contrario test
 * of Desolneux, Moisan, Morel, "From Gestalt Theory to Image Analysis", 2008, to first order).
 * Small enough is what admits less than one of Admission::false_loops; where odometry can judge no
 * loop, `max_chance`.
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
