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
 * Each loop closure with the odometry from both first key nodes is one measurement of the frame,
 * with the covariances of all three. They are averaged robustly: the measurement of least truncated
 * cost is the start of graduated non-convexity with truncated least squares.
 * \param admitted one flag for each edge. */
std::vector<FrameAverage> frameAverages(const PoseGraph& graph, const OdometryChains& chains,
                                        const std::vector<bool>& admitted);

}  // namespace lamp
