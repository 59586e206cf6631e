#pragma once

#include <memory>
#include <vector>

#include "lamp/pose_graph/Optimizer.h"
#include "lamp/pose_graph/OutlierRejection.h"

namespace lamp {

/** The back end (paper II-D): the outlier rejections in turn, then the optimiser. */
struct BackEnd {
  std::vector<std::shared_ptr<OutlierRejection>> rejections;
  std::shared_ptr<Optimizer> optimizer;

  /** Judges every admitted loop closure afresh, whatever its earlier verdict.
   * \param admitted one flag per edge. */
  OptimizationResult optimize(const PoseGraph& graph, std::vector<bool> admitted) const;
  /** Admits all loop closures. */
  OptimizationResult optimize(const PoseGraph& graph) const {
    return optimize(graph, std::vector<bool>(graph.edges().size(), true));
  }

 private:
  OptimizationResult optimize(const PoseGraph& graph, Admission admission) const;
};

}  // namespace lamp
