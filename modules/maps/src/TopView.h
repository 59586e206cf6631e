#pragma once

#include <Eigen/Geometry>

#include "lamp/maps/MapExporter.h"

namespace lamp {

/** Orthographic view from above: +x to the right, +y up. */
struct TopView {
  double pixel_m = 1.0;                                ///< edge of a pixel
  Eigen::Vector2d top_left = Eigen::Vector2d::Zero();  ///< world, metres
  int width = 1, height = 1;                           ///< pixels

  /** Pixel coordinates; whole numbers are the corners of pixels, and (0, 0) is the top left one. */
  Eigen::Vector2d toPixel(const Eigen::Vector3d& world) const {
    return {(world.x() - top_left.x()) / pixel_m, (top_left.y() - world.y()) / pixel_m};
  }
};

/** The view that shows all trajectories and loop closures, and the points but for the outermost
 * 0.1 % on each side. The longer side has at most `size_px` pixels, none below `finest_pixel_m`. */
TopView viewOf(const ComponentMap& map, int size_px, double finest_pixel_m);
/** The view that shows a box, in metres, and a margin around it. */
TopView viewOf(const Eigen::AlignedBox2d& box, int size_px, double finest_pixel_m);

}  // namespace lamp
