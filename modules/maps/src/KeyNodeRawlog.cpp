#include "lamp/maps/KeyNodeRawlog.h"

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "MapPoints.h"
#include "lamp/core/MrptFile.h"
#include "lamp/core/ScanObservation.h"

namespace lamp {

namespace {

void checkPacket(const KeyNodePacket& packet, const std::string& robot) {
  const std::string owner = "key node " + robot + ":" + std::to_string(packet.id.index);
  if (!std::isfinite(packet.stamp) || !isFinite(packet.odom_T_base))
    throw std::runtime_error("no rawlog is written: " + owner +
                             " has a stamp or an odometry pose that is not finite");
  if (packet.scan) checkScan(*packet.scan, owner);
}

std::vector<const KeyNodePacket*> inStampOrder(const std::vector<KeyNodePacket>& packets) {
  std::vector<const KeyNodePacket*> sorted;
  sorted.reserve(packets.size());
  for (const KeyNodePacket& packet : packets) sorted.push_back(&packet);
  std::stable_sort(
      sorted.begin(), sorted.end(),
      [](const KeyNodePacket* a, const KeyNodePacket* b) { return a->stamp < b->stamp; });
  return sorted;
}

mrpt::obs::CObservationRobotPose odometryOf(const KeyNodePacket& packet, const std::string& robot) {
  mrpt::obs::CObservationRobotPose odometry;
  odometry.sensorLabel = robot + "/odometry";
  odometry.timestamp = mrpt::Clock::fromDouble(packet.stamp);
  odometry.pose.mean =
      mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(packet.odom_T_base.matrix()));
  odometry.pose.cov.setZero();
  return odometry;
}

}  // namespace

void writeKeyNodeRawlog(const std::string& path, const std::string& robot,
                        const std::vector<KeyNodePacket>& packets) {
  for (const KeyNodePacket& packet : packets) checkPacket(packet, robot);
  writeMrptFile(path, [&](const MrptSink& sink) {
    for (const KeyNodePacket* packet : inStampOrder(packets)) {
      sink(odometryOf(*packet, robot));
      if (!packet->scan) continue;
      for (size_t sensor = 0; sensor < packet->scan->sensors.size(); ++sensor)
        sink(scanObservation(*packet->scan, sensor, robot, packet->stamp));
    }
  });
}

}  // namespace lamp
