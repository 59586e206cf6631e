#pragma once

#include <Eigen/Core>
#include <cmath>

namespace lamp {

/** Where the origin of a frame near a place should be: at whole kilometres, and at the world's own
 * origin if that is less than a kilometre away along each axis. Numbers that people recognise, and
 * single precision resolves 0.1 mm around it. World, metres. */
inline Eigen::Vector3d wholeKilometres(const Eigen::Vector3d& world_p) {
  constexpr double kKilometre = 1000;
  return world_p.unaryExpr([](double x) { return std::trunc(x / kKilometre) * kKilometre; });
}

}  // namespace lamp
