#pragma once

#include <vector>

#include "rejection/LoopCycles.h"

namespace lamp {

class LoopChances;

/** Loop closures that their neighbours bear out, where chance hardly would; one for each pair of
 * places, since loops between the same two places may share one mistake, and tell no more than one
 * of them does. Odometry is used only over the few key nodes between neighbours, so its accuracy
 * hardly matters, nor does the number of false loops among the true ones.
 * \return their indices in `loops`, ascending. */
std::vector<size_t> witnesses(const std::vector<DirectedLoop>& loops, const OdometryChains& chains,
                              const LoopChances& chances);

}  // namespace lamp
