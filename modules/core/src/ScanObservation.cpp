#include "lamp/core/ScanObservation.h"

#include <mrpt/core/Clock.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>

#include <algorithm>

namespace lamp {

namespace {

mrpt::maps::CPointsMap::Ptr pointsOf(const Scan& scan, size_t sensor) {
  const Eigen::Vector3d origin = scan.sensors[sensor].position;
  const auto with_intensity = scan.hasIntensity() ? mrpt::maps::CPointsMapXYZI::Create() : nullptr;
  const mrpt::maps::CPointsMap::Ptr points =
      with_intensity ? mrpt::maps::CPointsMap::Ptr(with_intensity)
                     : mrpt::maps::CPointsMap::Ptr(mrpt::maps::CSimplePointsMap::Create());
  points->reserve(static_cast<size_t>(
      std::count(scan.sensor.begin(), scan.sensor.end(), static_cast<uint8_t>(sensor))));
  for (size_t i = 0; i < scan.size(); ++i) {
    if (scan.sensor[i] != sensor) continue;
    const Eigen::Vector3f p = (scan.points[i].cast<double>() - origin).cast<float>();
    points->insertPointFast(p.x(), p.y(), p.z());
    if (with_intensity) with_intensity->setPointIntensity(points->size() - 1, scan.intensity[i]);
  }
  return points;
}

}  // namespace

mrpt::obs::CObservationPointCloud scanObservation(const Scan& scan, size_t sensor,
                                                  const std::string& robot, double stamp) {
  const SensorOrigin& origin = scan.sensors[sensor];
  mrpt::obs::CObservationPointCloud cloud;
  cloud.sensorLabel = robot + "/" + (origin.label.empty() ? "lidar" : origin.label);
  cloud.timestamp = mrpt::Clock::fromDouble(stamp);
  cloud.sensorPose = mrpt::poses::CPose3D::FromTranslation(origin.position.x(), origin.position.y(),
                                                           origin.position.z());
  cloud.pointcloud = pointsOf(scan, sensor);
  return cloud;
}

}  // namespace lamp
