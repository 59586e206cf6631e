#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lamp/pose_graph/OutlierRejection.h"

namespace lamp {

struct IcmOptions {
  std::string test = "uncertainty";
  double inlier_probability = 0.9999;
  double max_translation_per_node_m = 0.05;
  double max_rotation_per_node_rad = 0.005;
  int max_search_steps = 10000;

  void visit(OptionVisitor& v);
};

/** Incremental consistency maximisation: keeps the largest set of loop closures that are pairwise
 * consistent, given the odometry between their ends (Ebadi et al., ICRA 2020; Mangelson et al.,
 * ICRA 2018, "Pairwise Consistent Measurement Set Maximization").
 *
 * Only loops between the same two chains of odometry are compared, be they one robot's or two. Two
 * loops agree if the cycle through both closes. The test `uncertainty` judges this by the cycle's
 * squared Mahalanobis distance, from the covariances of odometry and loops. The test `per_node`,
 * meant for comparison, applies LAMP's fixed thresholds per key node along the cycle; there each
 * loop must agree with odometry in the same way, too.
 *
 * Comparisons are remembered: later calls compare only the new loops, unless earlier ones have
 * changed. */
class Icm : public OutlierRejection {
  DEFINE_MRPT_OBJECT(Icm, lamp)

 public:
  explicit Icm(const IcmOptions& options = {});
  ~Icm() override;

  void visit(OptionVisitor& options) override { options_.visit(options); }
  Admission reject(const PoseGraph& graph, Admission before) override;

 private:
  class Group;

  IcmOptions options_;
  std::map<std::pair<int, int>, std::shared_ptr<Group>> groups_;  ///< by chains
};

}  // namespace lamp
