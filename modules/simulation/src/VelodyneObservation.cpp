#include "lamp/simulation/VelodyneObservation.h"

#include <mrpt/obs/CObservationVelodyneScan.h>

#include <algorithm>
#include <cstring>

#include "MrptConversions.h"
#include "VelodynePackets.h"

namespace lamp::simulation {
namespace {

using mrpt::obs::CObservationVelodyneScan;
using RawPacket = CObservationVelodyneScan::TVelodyneRawPacket;

RawPacket toMrpt(const VelodynePacket& packet) {
  static_assert(sizeof(RawPacket) == sizeof(packet.bytes));
  RawPacket raw;  // its header fields are private
  std::memcpy(static_cast<void*>(&raw), packet.bytes.data(), sizeof raw);
  return raw;
}

/** A copy of MRPT's table, which its loader fills without a lock. */
const mrpt::obs::VelodyneCalibration& calibration() {
  static const auto table = mrpt::obs::VelodyneCalibration::LoadDefaultCalibration("VLP16");
  return table;
}

std::shared_ptr<CObservationVelodyneScan> emptyObservation(const Lidar& lidar, double stamp,
                                                           const std::string& label) {
  auto observation = CObservationVelodyneScan::Create();
  observation->sensorLabel = label;
  observation->timestamp = stampToMrpt(stamp);
  observation->originalReceivedTimestamp = observation->timestamp;
  observation->minRange = lidar.options().min_range_m;
  observation->maxRange = lidar.options().max_range_m;
  observation->calibration = calibration();
  return observation;
}

}  // namespace

std::vector<std::shared_ptr<CObservationVelodyneScan>> velodyneObservations(
    const LidarSweep& sweep, const Lidar& lidar, const std::string& label) {
  const auto packets = velodynePackets(sweep, lidar.pattern());
  const size_t size = lidar.rotates() ? static_cast<size_t>(lidar.options().packets_per_observation)
                                      : packets.size();
  std::vector<std::shared_ptr<CObservationVelodyneScan>> observations;
  for (size_t first = 0; first < packets.size(); first += size) {
    const size_t end = std::min(first + size, packets.size());
    const double begin_s = packets[first].delay_s;
    const double end_s = end < packets.size() ? packets[end].delay_s : sweep.duration_s;
    auto observation = emptyObservation(lidar, sweep.begin_stamp + begin_s, label);
    const double middle = sweep.begin_stamp + 0.5 * (begin_s + end_s);
    observation->sensorPose = poseToMrpt(lidar.baseTSensor(middle));
    for (size_t i = first; i < end; ++i) observation->scan_packets.push_back(toMrpt(packets[i]));
    observations.push_back(std::move(observation));
  }
  return observations;
}

}  // namespace lamp::simulation
