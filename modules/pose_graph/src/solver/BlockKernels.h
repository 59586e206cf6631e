#pragma once

#include <vector>

#include "solver/BlockKernel.h"

namespace lamp {

/** The kernels that this processor can run, the fastest first, a portable one last. */
std::vector<const BlockKernels*> availableBlockKernels();

/** The fastest that this processor can run. */
const BlockKernels& bestBlockKernels();

}  // namespace lamp
