#pragma once

#include <string>

#include "lamp/core/Options.h"

namespace lamp {

/** Options of the exporters that write point clouds. */
struct CloudOptions {
  double voxel_m = 0.05;
  bool moving = false;
  std::string color = "robot";
  bool normals = false;
  double tile_m = 0;

  void visit(OptionVisitor& v) {
    v("voxel_m", voxel_m, "m",
      "voxel size of the output; each voxel keeps the point nearest the mean of those in it; 0 "
      "keeps every point",
      kNotNegative);
    v("moving", moving,
      "whether points stay of which the occupancy says that they moved away, or are dust");
    v("color", color, "what points are coloured by", {"robot", "intensity", "height", "time"});
    v("normals", normals, "whether points have normals, which face the sensor that saw them");
    v("tile_m", tile_m, "m",
      "side of the tiles into which the cloud is divided, each a file; 0 writes one file",
      kNotNegative);
  }
};

}  // namespace lamp
