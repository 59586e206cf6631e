#pragma once

#include <vector>

#include "solver/BlockMatrix.h"

namespace lamp {

/** The place of each row of a symmetric matrix in an order of elimination with little fill-in, by
 * approximate minimum degree: quick, and best for loosely connected graphs. */
std::vector<int> minimumDegreeOrder(int size, const std::vector<BlockPair>& pairs);

/** The same by nested dissection (Karypis, Kumar, "A fast and high quality multilevel scheme for
 * partitioning irregular graphs", SIAM J. Sci. Comput. 1998): takes longer, but cuts the work to a
 * fraction where loops are many. The same pairs give the same order. */
std::vector<int> nestedDissectionOrder(int size, const std::vector<BlockPair>& pairs);

}  // namespace lamp
