#pragma once

#include <vector>

#include "lamp/refinement/JointAdjustment.h"
#include "lamp/refinement/Surfels.h"

namespace lamp {

/** \param surfaces of which the parts held back count. \param surfels found at the same poses. */
HeldBackFit heldBackFit(const std::vector<SplitSurface>& surfaces,
                        const std::vector<Surfel>& surfels, const std::vector<Pose3>& world_T_node,
                        double cell_m);

}  // namespace lamp
