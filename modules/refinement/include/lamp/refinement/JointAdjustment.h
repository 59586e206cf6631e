#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "lamp/core/KeyedScan.h"
#include "lamp/core/PoseGraph.h"
#include "lamp/refinement/RefinementOptions.h"

namespace lamp {

/** How far patches of surface that took no part lie from the planes that other key nodes have seen
 * there. */
struct HeldBackFit {
  size_t patches = 0;
  double rms_m = 0;
};

struct JointAdjustmentReport {
  int rounds = 0;      ///< computed, the last of which may have been undone
  size_t surfels = 0;  ///< in the first round
  size_t pairs = 0;    ///< of key nodes tied by surfels, in the first round
  HeldBackFit before, after;
  bool kept = false;  ///< whether the poses are better by the patches held back, and have changed
};

struct JointAdjustmentResult {
  std::vector<Pose3> world_T_base;                        ///< in the order of PoseGraph::nodes()
  std::vector<std::optional<Eigen::Vector3d>> landmarks;  ///< as OptimizationResult::landmarks
  JointAdjustmentReport report;
};

/** Adjusts the poses of all key nodes together, so that what they have seen of the same surfaces
 * falls into one plane each: bundle adjustment with planes as features (Liu, Zhang, "BALM: Bundle
 * Adjustment for Lidar Mapping", RA-L 2021), with all else that the graph knows.
 *
 * In each round the planes are found at the present poses (findSurfels()) and eliminated: of a
 * plane through what its viewers have seen there remain the distances between every two of them.
 * They make an edge for each of many pairs of key nodes (chooseSurfelPairs()), with the step and
 * the information of a registration. Loop closures between the same key nodes keep only what these
 * edges do not know; odometry, priors, gravity and all other edges stay. Rounds go on while patches
 * of surface that were held back come nearer to the planes of others. Nothing changes where there
 * is a planar robot, whose scans have no planes.
 *
 * \param scans one for each node of the graph, in their order.
 * \param go_on asked before each round, with the share of the work that is done. */
JointAdjustmentResult adjustJointly(const PoseGraph& graph, const std::vector<KeyedScanPtr>& scans,
                                    const RefinementOptions& options,
                                    const std::function<bool(double share)>& go_on);

}  // namespace lamp
