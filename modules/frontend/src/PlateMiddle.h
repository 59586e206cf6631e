#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lamp/frontend/GateCalibration.h"

namespace lamp {

/** A ray, and whether it shines. */
struct JudgedRay {
  LidarRay ray;
  bool shines = false;
};

/** The middle of a plate as the rays tell. */
struct PlateMiddle {
  Eigen::Vector3d position;    ///< base frame, metres
  Eigen::Matrix3d covariance;  ///< base frame, m²
  double misfit = 0;           ///< rays that contradict the plate, as a share of those that hit it
};

/** Square plates that lie alike. */
struct PlateFrame {
  Eigen::Matrix3d base_R_plate;          ///< axes along the edges, and across
  std::vector<Eigen::Vector3d> middles;  ///< base frame, metres; as supposed
  double size_m = 0;                     ///< length of the edges
};

/** Where the middle of a square plate lies: rays that shine have hit it, others that have come as
 * far have passed it by. All places that agree with the rays weigh alike, and one less by each ray
 * that does not. Of several plates that lie to each other as supposed it is the middle of the
 * first: the rays tell how far all lie off, so that each plate narrows what the others leave open.
 * \return none if too few rays hit. */
std::optional<PlateMiddle> plateMiddle(const std::vector<JudgedRay>& rays,
                                       const PlateFrame& plates);

}  // namespace lamp
