#pragma once

#include "lamp/core/KeyedScan.h"
#include "lamp/core/Options.h"

namespace lamp {

/** One point, the mean in place, intensity and time, for each occupied cell of a grid with edge
 * `leaf_m` (metres). Points of different sensors are not mixed, so that each keeps its true ray.
 * Points that are not finite, or farther than 1000 km, are left out. Order: by first point. */
Scan voxelFilter(const Scan& scan, double leaf_m);

struct AdaptiveVoxelOptions {
  int target_points = 3000;
  double initial_leaf_m = 0.45;
  double min_leaf_m = 0.1;
  double max_leaf_m = 0.8;
  int max_passes = 4;

  void visit(OptionVisitor& v);
};

/** Adaptive voxel filter (paper II-B, after LOCUS 2.0): feedback on the leaf size keeps the number
 * of points near a target whatever the lidar and the room. The leaf is corrected within a scan,
 * too, so that already the first key node has the right size. Points that have no other one within
 * the largest leaf are dust, rain or false returns, and left out, unless the scan is thin
 * altogether. */
class AdaptiveVoxelFilter {
 public:
  explicit AdaptiveVoxelFilter(const AdaptiveVoxelOptions& options);
  Scan filter(const Scan& scan);
  /** The leaf size that the last scan was filtered with, metres. */
  double leaf() const { return leaf_; }

 private:
  double corrected(size_t points) const;

  AdaptiveVoxelOptions options_;
  double leaf_;
};

}  // namespace lamp
