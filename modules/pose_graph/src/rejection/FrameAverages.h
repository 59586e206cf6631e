#pragma once

#include <vector>

#include "rejection/OdometryChains.h"

namespace lamp {

/** Where loop closures between two chains of odometry put one chain in the other's frame. */
struct FrameAverage {
  int a, b;                               ///< chains, a < b
  RelativePose a_T_b;                     ///< between their first key nodes
  size_t loops = 0;                       ///< between the two
  std::vector<EdgeIndex> agreeing_loops;  ///< those that agree with the average
  size_t agreeing = 0;                    ///< of those, how many do not share a key node
};

/** One average for each pair of chains that admitted loops join, by (a, b).
 *
 * Each loop closure, with the odometry from both chains' first key nodes to its ends, is one
 * measurement of the frame, with the covariances of all three. The measurements are averaged
 * robustly, by graduated non-convexity with truncated least squares, which starts at the
 * measurement of least truncated cost.
 * \param admitted one flag per edge. */
std::vector<FrameAverage> frameAverages(const PoseGraph& graph, const OdometryChains& chains,
                                        const std::vector<bool>& admitted);

}  // namespace lamp
