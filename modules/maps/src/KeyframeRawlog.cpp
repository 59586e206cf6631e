#include "lamp/maps/KeyframeRawlog.h"

#include <mrpt/core/Clock.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "MapPoints.h"
#include "lamp/core/RawlogFile.h"

namespace lamp {

namespace {

void checkPacket(const KeyframePacket& packet, const std::string& robot) {
  const std::string owner = "key node " + robot + ":" + std::to_string(packet.id.index);
  if (!std::isfinite(packet.stamp) || !isFinite(packet.odom_T_base))
    throw std::runtime_error("no rawlog is written: " + owner +
                             " has a stamp or an odometry pose that is not finite");
  if (packet.scan) checkScan(*packet.scan, owner);
}

std::vector<const KeyframePacket*> inStampOrder(const std::vector<KeyframePacket>& packets) {
  std::vector<const KeyframePacket*> sorted;
  sorted.reserve(packets.size());
  for (const KeyframePacket& packet : packets) sorted.push_back(&packet);
  std::stable_sort(
      sorted.begin(), sorted.end(),
      [](const KeyframePacket* a, const KeyframePacket* b) { return a->stamp < b->stamp; });
  return sorted;
}

mrpt::obs::CObservationRobotPose odometryOf(const KeyframePacket& packet,
                                            const std::string& robot) {
  mrpt::obs::CObservationRobotPose odometry;
  odometry.sensorLabel = robot + "/odometry";
  odometry.timestamp = mrpt::Clock::fromDouble(packet.stamp);
  odometry.pose.mean =
      mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(packet.odom_T_base.matrix()));
  odometry.pose.cov.setZero();
  return odometry;
}

mrpt::maps::CPointsMap::Ptr pointsOf(const Scan& scan, uint8_t sensor) {
  const Eigen::Vector3d origin = scan.sensors[sensor].position;
  const auto with_intensity = scan.hasIntensity() ? mrpt::maps::CPointsMapXYZI::Create() : nullptr;
  const mrpt::maps::CPointsMap::Ptr points =
      with_intensity ? mrpt::maps::CPointsMap::Ptr(with_intensity)
                     : mrpt::maps::CPointsMap::Ptr(mrpt::maps::CSimplePointsMap::Create());
  points->reserve(std::count(scan.sensor.begin(), scan.sensor.end(), sensor));
  for (size_t i = 0; i < scan.size(); ++i) {
    if (scan.sensor[i] != sensor) continue;
    const Eigen::Vector3f p = (scan.points[i].cast<double>() - origin).cast<float>();
    points->insertPointFast(p.x(), p.y(), p.z());
    if (with_intensity) with_intensity->setPointIntensity(points->size() - 1, scan.intensity[i]);
  }
  return points;
}

mrpt::obs::CObservationPointCloud cloudOf(const KeyframePacket& packet, uint8_t sensor,
                                          const std::string& robot) {
  const SensorOrigin& origin = packet.scan->sensors[sensor];
  mrpt::obs::CObservationPointCloud cloud;
  cloud.sensorLabel = robot + "/" + (origin.label.empty() ? "lidar" : origin.label);
  cloud.timestamp = mrpt::Clock::fromDouble(packet.stamp);
  cloud.sensorPose = mrpt::poses::CPose3D::FromTranslation(origin.position.x(), origin.position.y(),
                                                           origin.position.z());
  cloud.pointcloud = pointsOf(*packet.scan, sensor);
  return cloud;
}

}  // namespace

void writeKeyframeRawlog(const std::string& path, const std::string& robot,
                         const std::vector<KeyframePacket>& packets) {
  for (const KeyframePacket& packet : packets) checkPacket(packet, robot);
  writeRawlog(path, [&](const RawlogSink& sink) {
    for (const KeyframePacket* packet : inStampOrder(packets)) {
      sink(odometryOf(*packet, robot));
      if (!packet->scan) continue;
      for (size_t sensor = 0; sensor < packet->scan->sensors.size(); ++sensor)
        sink(cloudOf(*packet, static_cast<uint8_t>(sensor), robot));
    }
  });
}

}  // namespace lamp
