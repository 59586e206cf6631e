#pragma once

#include <mrpt/obs/CObservation.h>

#include <optional>
#include <string>
#include <vector>

#include "lamp/core/KeyedScan.h"
#include "lamp/core/Options.h"

namespace lamp {

/** Which returns of a lidar are used. */
struct ScanOptions {
  double min_range_m = 0.1;
  double max_range_m = 120.0;
  double laser_aperture_deg = 0;
  std::vector<double> body_box;

  void visit(OptionVisitor& v);
};

/** CObservationPointCloud, CObservationVelodyneScan, CObservationRotatingScan,
 * CObservation3DRangeScan, CObservation2DRangeScan, or CObservationTimedPoints. */
bool isLidar(const mrpt::obs::CObservation& observation);

/** A 2D laser whose plane is level on the robot to within 2 degrees, either side up. */
bool isPlanarLaser(const mrpt::obs::CObservation& observation);

/** Angle between a sensor's x-y plane and the robot's, radians, 0 to pi/2. */
double laserTilt(const mrpt::obs::CObservation& observation);

/** Points of a lidar observation in the base frame, with the sensor as the one origin of the rays.
 *
 * Left out are points that are not finite, returns that the sensor marks as invalid, and ranges
 * outside the options' and the sensor's own limits, and what lies within the box of the robot's
 * body. Intensity is 0 to 1 for lidars that give bytes, else as recorded; empty where there is
 * none. Times are seconds since the observation's stamp, where the recording tells when each point
 * was measured.
 *
 * \return none if the class is no lidar; a scan without points if it saw nothing.
 * \throws std::runtime_error if a cloud that is stored in a file of its own cannot be loaded, if
 * the sensor pose is not finite, if the lidar's model, and so the elevation of its rays, is not
 * known, or if the times of its points spread over more than a second. */
std::optional<Scan> scanFromObservation(const mrpt::obs::CObservation& observation,
                                        const std::string& label, const ScanOptions& options);

}  // namespace lamp
