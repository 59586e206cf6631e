#pragma once

#include <mrpt/obs/CObservationVelodyneScan.h>

#include <vector>

namespace lamp {

/** One laser of a Velodyne lidar, by the angles and offsets that its maker calibrates. */
struct VelodyneLaser {
  double elevation_rad = 0;
  double azimuth_rad = 0;          ///< what it lags behind the lidar's azimuth, clockwise
  double distance_offset_m = 0;    ///< to be added to what it measures
  double vertical_offset_m = 0;    ///< of its ray from the lidar's axes, across the ray, up
  double horizontal_offset_m = 0;  ///< to the left
};

/** How a Velodyne lidar fires, and how its returns lie in packets. */
struct VelodyneModel {
  std::vector<VelodyneLaser> lasers;  ///< in order of firing
  int firings_per_block = 1;          ///< of all lasers, one after the other
  double firing_s = 0;                ///< from one firing of all lasers to the next
  double laser_s = 0;                 ///< from one laser to the next

  double blockDuration() const { return firings_per_block * firing_s; }
  int lasersPerBlock() const;
};

/** Lasers as the recording has calibrated them, else as the manual of the model lists them.
 * VLP-16, Puck Hi-Res and HDL-32E are known by the mark in their packets; HDL-64E needs the
 * calibration, as each unit is another.
 * \throws std::runtime_error if the model is none of these. */
VelodyneModel velodyneModel(const mrpt::obs::CObservationVelodyneScan& scan);

/** The model that a name in CObservationRotatingScan stands for: `VLP-16`, `HDL-32E`.
 * \throws std::runtime_error for others. */
VelodyneModel velodyneModel(const std::string& name);

}  // namespace lamp
