#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <optional>
#include <vector>

#include "lamp/core/Geometry.h"

namespace lamp {

/** Compares a 2D laser's field of view with what turning shows: a robot that turns by an angle sees
 * the same ranges so many beams farther on. Some recordings say 90 degrees of a laser that saw 180,
 * and every scan of them is bent. */
class ApertureCheck {
 public:
  /** Scans of one laser in time order. \param aperture_rad its field of view as it is used. */
  void observe(const mrpt::obs::CObservation2DRangeScan& scan, double aperture_rad,
               const Pose3& odom_T_base);

  /** The field of view that turning shows, radians, if enough was seen to contradict the used one.
   */
  std::optional<double> contradiction() const;
  double used() const { return aperture_rad_; }
  /** Whether enough was seen. */
  bool decided() const;

 private:
  struct View {
    std::vector<float> ranges;  ///< zero where there is none
    Pose3 odom_T_base = Pose3::Identity();
  };

  std::optional<View> reference_;
  double aperture_rad_ = 0;
  double turned_rad_ = 0;  ///< in all pairs of scans that could be compared
  double shifted_beams_ = 0;
  size_t beams_ = 0;
};

}  // namespace lamp
