#pragma once

#include <memory>
#include <vector>

#include "lamp/pose_graph/Optimizer.h"
#include "lamp/pose_graph/OutlierRejection.h"

namespace lamp {

/** The back end of the paper's II-D: outlier rejections, one after the other, then the optimiser.
 */
struct BackEnd {
  std::vector<std::shared_ptr<OutlierRejection>> rejections;
  std::shared_ptr<Optimizer> optimizer;

  /** Every admitted loop gets a new chance, whatever its verdict was before.
   * \param admitted one flag for each edge. */
  OptimizationResult optimize(const PoseGraph& graph, std::vector<bool> admitted) const;
  /** All loops may take part. */
  OptimizationResult optimize(const PoseGraph& graph) const {
    return optimize(graph, std::vector<bool>(graph.edges().size(), true));
  }

 private:
  OptimizationResult optimize(const PoseGraph& graph, Admission admission) const;
};

}  // namespace lamp
