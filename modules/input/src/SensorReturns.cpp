#include "SensorReturns.h"

#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>

#include <cmath>

namespace lamp {
namespace {

void setPoints(SensorReturns& returns, const std::vector<float>& x, const std::vector<float>& y,
               const std::vector<float>& z) {
  returns.points.reserve(x.size());
  for (size_t i = 0; i < x.size(); ++i) returns.points.emplace_back(x[i], y[i], z[i]);
}

}  // namespace

SensorReturns returnsOf(const mrpt::obs::CObservationPointCloud& observation) {
  observation.load();
  SensorReturns returns;
  if (!observation.pointcloud) return returns;
  const auto& cloud = *observation.pointcloud;
  const auto& x = cloud.getPointsBufferRef_x();
  const auto& y = cloud.getPointsBufferRef_y();
  const auto& z = cloud.getPointsBufferRef_z();
  returns.points.reserve(cloud.size());
  for (size_t i = 0; i < cloud.size(); ++i) returns.points.emplace_back(x[i], y[i], z[i]);
  if (const auto* xyzi = dynamic_cast<const mrpt::maps::CPointsMapXYZI*>(&cloud)) {
    const auto& intensity = xyzi->getPointsBufferRef_intensity();
    returns.intensity.assign(intensity.begin(), intensity.end());
  }
  return returns;
}

SensorReturns returnsOf(const CObservationTimedPoints& observation) {
  SensorReturns returns;
  setPoints(returns, observation.x, observation.y, observation.z);
  returns.intensity = observation.intensity;
  returns.time = observation.time;
  return returns;
}

SensorReturns returnsOf(const mrpt::obs::CObservation3DRangeScan& observation) {
  observation.load();
  SensorReturns returns;
  if (observation.hasPoints3D) {
    setPoints(returns, observation.points3D_x, observation.points3D_y, observation.points3D_z);
  } else if (observation.hasRangeImage && !observation.rangeImage.empty()) {
    // MRPT undistorts and projects, but writes into the observation.
    auto scan = observation;
    mrpt::maps::CSimplePointsMap cloud;
    scan.unprojectInto(cloud);
    returns.points.reserve(cloud.size());
    for (size_t i = 0; i < cloud.size(); ++i) {
      mrpt::math::TPoint3Df p;
      cloud.getPoint(i, p.x, p.y, p.z);
      returns.points.emplace_back(p.x, p.y, p.z);
    }
  }
  return returns;
}

SensorReturns returnsOf(const mrpt::obs::CObservation2DRangeScan& observation) {
  SensorReturns returns;
  for (size_t i = 0; i < observation.getScanSize(); ++i) {
    const float range = observation.getScanRange(i);
    // Many drivers write the maximum range for "no return" and forget the flag.
    if (!observation.getScanRangeValidity(i) || range >= observation.maxRange) continue;
    const float angle = observation.getScanAngle(i);
    returns.points.emplace_back(range * std::cos(angle), range * std::sin(angle), 0.0f);
    if (observation.hasIntensity()) {
      returns.intensity.push_back(static_cast<float>(observation.getScanIntensity(i)));
    }
  }
  return returns;
}

}  // namespace lamp
