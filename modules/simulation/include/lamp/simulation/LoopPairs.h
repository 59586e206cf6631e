#pragma once

#include <string>
#include <vector>

#include "lamp/core/KeyedScan.h"
#include "lamp/simulation/Mission.h"

namespace lamp::simulation {

/** Two key nodes of a team and what is true of them. */
struct LoopPair {
  KeyNodeId from, to;
  double from_stamp, to_stamp;
  Pose3 from_T_to;
  double overlap;
  bool same_place;  ///< a true pair
  bool look_alike;  ///< far apart, in places that look alike
};

/** True pairs (overlap of the scans of at least 0.3) and false ones (below 0.05), up to
 * `pairs` of each, drawn at random: pairs within search range (25 m) that are no
 * neighbours in sequence, and for a third of the false ones, or more where the others are rare,
 * pairs at look-alike places. Overlap as core's scanOverlap(). In the order of key nodes. \param
 * scans of each robot, one a key node. Runs on the caller's TBB arena. */
std::vector<LoopPair> findLoopPairs(const Mission& mission, const Layout& layout,
                                    const std::vector<std::vector<KeyedScanPtr>>& scans,
                                    size_t pairs, uint64_t seed);

}  // namespace lamp::simulation
