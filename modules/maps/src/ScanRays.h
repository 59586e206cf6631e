#pragma once

#include <unordered_map>

#include "VoxelBlock.h"
#include "lamp/core/Geometry.h"
#include "lamp/core/KeyedScan.h"

namespace lamp {

/** What the rays of one scan say of the voxels of one block. */
struct BlockRays {
  VoxelBits hit;                    ///< a ray ends there
  VoxelBits near_hit;               ///< or in one of the 26 neighbours
  std::array<VoxelBits, 3> passed;  ///< at least one, two, three rays went through

  /** The scan speaks for free space: a ray went through, and nothing that the scan saw is near. */
  uint64_t pass(size_t word) const { return passed[0].words[word] & ~near_hit.words[word]; }
  /** So many rays went through that a thing in the voxel would have been hit. */
  uint64_t clearPass(size_t word) const { return passed[2].words[word] & ~near_hit.words[word]; }
  bool saysSomething() const;
  void addPass(size_t place);
};

/** What the rays of one scan say. */
struct ScanRays {
  std::unordered_map<BlockKey, BlockRays> blocks;
  size_t out_of_bounds = 0;  ///< rays left out because an end lies beyond the grid
};

/** Casts the rays of a scan from the origins of its sensors; points that are not finite are left
 * out. Near its end a ray is no witness: it says nothing where it is less than a voxel before the
 * surface that it hits, measured across the surface; at a grazing incidence that is a long way.
 * \param max_range_m longer rays are cut there: they mark free space but no obstacle. */
ScanRays castRays(const Scan& scan, const Pose3& world_T_base, double resolution_m,
                  double max_range_m);

}  // namespace lamp
