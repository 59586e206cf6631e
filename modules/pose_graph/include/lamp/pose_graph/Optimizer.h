#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lamp/core/PoseGraph.h"
#include "lamp/core/Stage.h"
#include "lamp/pose_graph/OutlierRejection.h"

namespace lamp {

/** The back end's verdict on a loop closure or another edge that may be rejected. */
struct LoopVerdict {
  EdgeIndex edge = 0;
  Verdict verdict = Verdict::kInlier;
  double weight = 1.0;  ///< 0..1
  double chi2 = 0.0;    ///< squared Mahalanobis residual at the solution
};

struct OptimizationReport {
  bool usable = true;       ///< false: the poses must not be used
  std::string termination;  ///< why the solver stopped, in words
  int iterations = 0;       ///< inner iterations, over all outer rounds
  int rounds = 1;           ///< outer (GNC) rounds
  double initial_cost = 0;  ///< half the weighted sum of squared residuals
  double final_cost = 0;
  std::vector<FrameAgreement> frames;  ///< between robots without a common start
  double odometry_scale = 1.0;         ///< applied to odometry's covariances
};

struct OptimizationResult {
  std::vector<Pose3> world_T_base;                        ///< in the order of PoseGraph::nodes()
  std::vector<std::optional<Eigen::Vector3d>> landmarks;  ///< none if no admitted edge places it
  /** One for each edge of the graph that may be rejected, in their order. */
  std::vector<LoopVerdict> loops;
  OptimizationReport report;
};

/** Poses of all key nodes and a verdict for each loop closure (paper II-D). */
class Optimizer : public Stage {
  DEFINE_VIRTUAL_MRPT_OBJECT(Optimizer)

 public:
  /** \param admitted one flag per edge; loops without it take no part and come out as outliers.
   * Earlier verdicts do not count. */
  virtual OptimizationResult optimize(const PoseGraph& graph,
                                      const std::vector<bool>& admitted) = 0;
  /** Makes the next call like the first one. */
  virtual void forget() {}
  /** Admits all loop closures. */
  OptimizationResult optimize(const PoseGraph& graph) {
    return optimize(graph, std::vector<bool>(graph.edges().size(), true));
  }
};

/** Writes poses, verdicts, weights and residuals of a usable result back into the graph. */
void applyResult(const OptimizationResult& result, PoseGraph& graph);

/** Registers the stages of this module. */
void registerAllClasses_lamp_pose_graph();

}  // namespace lamp
