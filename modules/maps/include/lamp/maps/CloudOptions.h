#pragma once

#include "lamp/core/Options.h"

namespace lamp {

/** Options of the exporters that write one point cloud. */
struct CloudOptions {
  double voxel_m = 0.05;

  void visit(OptionVisitor& v) {
    v("voxel_m", voxel_m, "m",
      "voxel size of the output; each voxel keeps its first point; 0 keeps every point",
      kNotNegative);
  }
};

}  // namespace lamp
