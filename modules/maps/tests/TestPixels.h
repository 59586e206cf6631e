#pragma once

#include <mrpt/img/CImage.h>

#include <Eigen/Core>

#include "lamp/maps/MapExporter.h"

namespace lamp {

inline Color pixelAt(const mrpt::img::CImage& image, int x, int y) {
  const uint8_t* p = image.ptrLine<uint8_t>(y) + 3 * x;
  return {p[2], p[1], p[0]};
}

/** Whether a pixel of white paper carries a fair amount of an ink. */
inline bool inked(Color pixel, Color ink) {
  const Eigen::Vector3d p(255 - pixel.r, 255 - pixel.g, 255 - pixel.b);
  const Eigen::Vector3d full(255 - ink.r, 255 - ink.g, 255 - ink.b);
  return p.norm() > 0.4 * full.norm() && p.dot(full) > 0.99 * p.norm() * full.norm();
}

}  // namespace lamp
