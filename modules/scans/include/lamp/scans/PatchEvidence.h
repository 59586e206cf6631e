#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/scans/PreparedScan.h"

namespace lamp {

/** A piece of surface about a metre wide, whatever the density of the points on it: a cell of a
 * grid in the frame of the scan that has seen it. */
using Patch = std::array<int64_t, 3>;

/** What one scan says of the patches that another one has seen. Of the others it says nothing. */
struct PatchEvidence {
  std::vector<Patch> agreeing;       ///< it has seen them, too
  std::vector<Patch> contradicting;  ///< its rays passed through them
};

/** Of the scan's own points; a patch counts for what most of its points say. Sorted.
 * \param other_T_scan pose of the scan. */
PatchEvidence patchEvidence(const PreparedScan& scan, const PreparedScan& other,
                            const Pose3& other_T_scan);

}  // namespace lamp
