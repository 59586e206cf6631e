#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "lamp/observations/CObservationTimedPoints.h"

namespace lamp {

/** Returns of a lidar in its own frame, unfiltered but for what the sensor marks as invalid. */
struct SensorReturns {
  std::vector<Eigen::Vector3f> points;
  std::vector<float> intensity;  ///< empty, or as long as `points`
  std::vector<float> time;       ///< seconds since the observation's stamp; empty where unknown
  double max_range_m = std::numeric_limits<double>::infinity();
};

SensorReturns returnsOf(const mrpt::obs::CObservationPointCloud& observation);
/** All returns of all firings, which MRPT's own reader leaves out in part. Packets are timed by
 * their own clock, the first one by the observation's stamp; points in them by the manual. \throws
 * std::runtime_error if the model of the lidar is not known. */
SensorReturns returnsOf(const mrpt::obs::CObservationVelodyneScan& observation);
SensorReturns returnsOf(const mrpt::obs::CObservationRotatingScan& observation);
SensorReturns returnsOf(const mrpt::obs::CObservation3DRangeScan& observation);
SensorReturns returnsOf(const CObservationTimedPoints& observation);
SensorReturns returnsOf(const mrpt::obs::CObservation2DRangeScan& observation);

}  // namespace lamp
