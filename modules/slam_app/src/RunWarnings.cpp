#include "RunWarnings.h"

#include "lamp/base_station/LoopCounts.h"

namespace lamp {

std::vector<std::string> runWarnings(const BaseStation& base) {
  std::vector<std::string> warnings;
  // A back end that hardly believes any loop closure has got wrong ones, or wrong odometry.
  const KeptLoops loops = keptLoops(base.graph(), base.lastReport().frames);
  if (base.optimizations() > 0 && loops.tooFew())
    warnings.push_back(
        "the back end kept only " + std::to_string(loops.kept) + " of " +
        std::to_string(loops.loops) +
        " verified loop closures: the map is hardly better than odometry. Most loop closures are "
        "wrong, or odometry is much worse than its covariances state (docs/pose_graph.md)");
  return warnings;
}

}  // namespace lamp
