#pragma once

#include <vector>

#include "lamp/base_station/PlacementScales.h"

namespace lamp {

/** Which of several placements of one robot in another's map is right. */
struct PlacementVerdict {
  size_t best = 0;                   ///< place in the list
  std::vector<size_t> equally_good;  ///< others that explain what both have seen about as well
  /** Share of the compared patches that contradict even the best one. */
  double contradicting = 0;
  bool contradicted = false;  ///< by so many that it is wrong, too
};

/** A placement explains what both robots have seen about as well as the best if it brings a good
 * part as much together, and does not contradict it much more often. What only one of them has seen
 * says nothing: a placement is not worse because less of the two maps overlaps.
 * \param placements at least one. */
PlacementVerdict judge(const std::vector<Placement>& placements);

}  // namespace lamp
