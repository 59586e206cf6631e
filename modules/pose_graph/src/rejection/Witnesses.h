#pragma once

#include <vector>

#include "rejection/LoopCycles.h"

namespace lamp {

class LoopChances;

/** Of loop closures that their neighbours bear out, where chance hardly would, one for each pair of
 * places: loops at the same two places may share one mistake, and tell no more than one of them
 * does. Odometry counts only over the few key nodes between neighbours, so that it hardly matters
 * how exact it is, nor how many false loops there are beside the true ones.
 * \return their places in `loops`, in order. */
std::vector<size_t> witnesses(const std::vector<DirectedLoop>& loops, const OdometryChains& chains,
                              const LoopChances& chances);

}  // namespace lamp
