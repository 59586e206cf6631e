#pragma once

#include <optional>
#include <vector>

#include "PlateMiddle.h"
#include "lamp/core/KeyNodePacket.h"

namespace lamp {

/** What points up, in the base frame. */
struct FeltUp {
  Eigen::Vector3d base_up;
  double sigma_rad = 0;
};

/** `world_T_base` that brings three points nearest to where they are in the world. */
Pose3 poseOfPoints(const std::vector<Eigen::Vector3d>& in_base,
                   const std::vector<Eigen::Vector3d>& in_world);

struct PlatePose {
  StartPrior pose;
  double chi_square = 0;
  int degrees_of_freedom = 0;
};

/** The pose of least squares, weighted by the covariances of the plates' middles. */
PlatePose poseOfPlates(const std::vector<PlateMiddle>& seen,
                       const std::vector<Eigen::Vector3d>& plates, const std::optional<FeltUp>& up,
                       const Pose3& guess);

}  // namespace lamp
