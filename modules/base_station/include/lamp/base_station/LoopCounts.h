#pragma once

#include "lamp/base_station/BaseStation.h"

namespace lamp {

/** How many loop closures got through each stage. */
struct LoopCounts {
  size_t candidates = 0;  ///< proposed by the generators, repeated proposals included
  size_t attempts = 0;    ///< computed
  size_t verified = 0;    ///< accepted by all verifiers
  size_t inliers = 0;     ///< kept by the back end
};

/** Inlier loop closures of one component. */
struct ComponentLoops {
  size_t within_robots = 0;
  size_t between_robots = 0;
};

LoopCounts countLoops(const BaseStation& base_station);

/** Verified loop closures that the last optimisation was free to keep, and how many it kept. Those
 * between robots whose frames are not joined are left out: they wait for more evidence. */
struct KeptLoops {
  size_t loops = 0, kept = 0;

  /** Less than a tenth was kept, of ten or more. */
  bool tooFew() const { return loops >= 10 && 10 * kept < loops; }
};
KeptLoops keptLoops(const PoseGraph& graph, const std::vector<FrameAgreement>& frames);

/** Edges other than odometry, priors and loop closures. */
struct MeasurementCounts {
  size_t edges = 0, inliers = 0;
};
MeasurementCounts countMeasurements(const PoseGraph& graph);

ComponentLoops countLoops(const PoseGraph& graph, const Component& component);

}  // namespace lamp
