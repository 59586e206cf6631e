#include <cmath>
#include <optional>

#include "SensorReturns.h"
#include "VelodyneModel.h"
#include "lamp/core/Median.h"

namespace lamp {
namespace {

using mrpt::obs::CObservationVelodyneScan;
using Packet = CObservationVelodyneScan::TVelodyneRawPacket;
using Block = CObservationVelodyneScan::raw_block_t;
using Return = CObservationVelodyneScan::laser_return_t;

constexpr int kBlocks = CObservationVelodyneScan::BLOCKS_PER_PACKET;
constexpr int kBlockReturns = CObservationVelodyneScan::SCANS_PER_BLOCK;
constexpr int kFullTurn = CObservationVelodyneScan::ROTATION_MAX_UNITS;
constexpr double kRangeUnit_m = 0.002;
constexpr double kAzimuthUnit_rad = 2.0 * M_PI / kFullTurn;
constexpr int64_t kHour_us = 3'600'000'000;
constexpr float kByteIntensity = 1.0f / 255.0f;

/** Blocks with one azimuth come from the same firing: both banks of an HDL-64E, and all returns of
 * a ray in a dual-return mode. */
struct BlockOrder {
  int firing[kBlocks] = {};          ///< its place in the packet
  const Block* other[kBlocks] = {};  ///< the block before with other returns of the same rays
  double azimuth_step_rad = 0;       ///< from firing to firing
};

/** The median, as a lidar with a limited field of view jumps from its end to its begin. */
double medianStep(const std::vector<int>& steps) {
  return steps.empty() ? 0 : medianOf(steps) * kAzimuthUnit_rad;
}

BlockOrder orderOf(const Packet& packet) {
  BlockOrder order;
  std::vector<int> steps;
  for (int i = 1; i < kBlocks; ++i) {
    const Block& block = packet.blocks[i];
    const Block& before = packet.blocks[i - 1];
    const bool same_firing = block.rotation() == before.rotation();
    order.firing[i] = order.firing[i - 1] + (same_firing ? 0 : 1);
    if (!same_firing)
      steps.push_back((block.rotation() - before.rotation() + kFullTurn) % kFullTurn);
    for (int k = i - 1; k >= 0 && order.firing[k] == order.firing[i] && !order.other[i]; --k)
      if (packet.blocks[k].header() == block.header()) order.other[i] = &packet.blocks[k];
  }
  order.azimuth_step_rad = medianStep(steps);
  return order;
}

/** Seconds from the first packet to each; none if packets carry no clock. */
std::optional<std::vector<double>> packetTimes(const std::vector<Packet>& packets) {
  std::vector<double> times;
  int64_t time_us = 0;
  for (size_t i = 0; i < packets.size(); ++i) {
    if (i > 0) {
      int64_t step = int64_t(packets[i].gps_timestamp()) - int64_t(packets[i - 1].gps_timestamp());
      if (step < -kHour_us / 2) step += kHour_us;  // the clock counts from the top of the hour
      time_us += step;
    }
    times.push_back(1e-6 * static_cast<double>(time_us));
  }
  if (packets.size() > 1 && time_us <= 0) return std::nullopt;
  return times;
}

/** A laser's ray, with what is the same for all azimuths. */
class LaserRay {
 public:
  explicit LaserRay(const VelodyneLaser& laser)
      : laser_(laser),
        cosine_(static_cast<float>(std::cos(laser.elevation_rad))),
        sine_(static_cast<float>(std::sin(laser.elevation_rad))),
        forward_m_(static_cast<float>(-laser.vertical_offset_m * std::sin(laser.elevation_rad))),
        left_m_(static_cast<float>(laser.horizontal_offset_m)),
        up_m_(static_cast<float>(laser.vertical_offset_m * std::cos(laser.elevation_rad))) {}

  double range(uint16_t raw) const { return raw * kRangeUnit_m + laser_.distance_offset_m; }

  /** \param azimuth_rad clockwise from the x axis, as the lidar turns. */
  Eigen::Vector3f pointAt(double range_m, double azimuth_rad) const {
    const auto range = static_cast<float>(range_m);
    const auto azimuth = static_cast<float>(azimuth_rad - laser_.azimuth_rad);
    const float sine = std::sin(azimuth), cosine = std::cos(azimuth);
    const float forward = range * cosine_ + forward_m_;
    return {forward * cosine + left_m_ * sine, left_m_ * cosine - forward * sine,
            range * sine_ + up_m_};
  }

 private:
  VelodyneLaser laser_;
  float cosine_, sine_;              ///< of the elevation
  float forward_m_, left_m_, up_m_;  ///< where the ray begins
};

class PacketReader {
 public:
  PacketReader(const CObservationVelodyneScan& scan, SensorReturns& returns)
      : model_(velodyneModel(scan)),
        rays_(model_.lasers.begin(), model_.lasers.end()),
        min_range_m_(scan.minRange),
        returns_(returns) {}

  void read(const Packet& packet, std::optional<double> packet_s) {
    const BlockOrder order = orderOf(packet);
    const double turn_rate = order.azimuth_step_rad / model_.blockDuration();
    for (int i = 0; i < kBlocks; ++i) {
      const Block& block = packet.blocks[i];
      const double begin_s = order.firing[i] * model_.blockDuration();
      const size_t first_laser = firstLaser(block);
      if (first_laser + static_cast<size_t>(model_.lasersPerBlock()) > model_.lasers.size())
        continue;
      const double azimuth = block.rotation() * kAzimuthUnit_rad;
      for (int k = 0; k < kBlockReturns; ++k) {
        if (order.other[i] && isSame(block, *order.other[i], k)) continue;
        const double delay_s = delay(k);
        const LaserRay& ray = rays_[first_laser + static_cast<size_t>(k % model_.lasersPerBlock())];
        if (add(block.laser_returns[k], ray, azimuth + turn_rate * delay_s) && packet_s)
          returns_.time.push_back(static_cast<float>(*packet_s + begin_s + delay_s));
      }
    }
  }

 private:
  /** Past the last laser for what is no block of returns. */
  size_t firstLaser(const Block& block) const {
    if (block.header() == CObservationVelodyneScan::UPPER_BANK) return 0;
    if (block.header() == CObservationVelodyneScan::LOWER_BANK) return kBlockReturns;
    return model_.lasers.size();
  }

  /** A ray with one return only has it in both blocks. */
  static bool isSame(const Block& a, const Block& b, int k) {
    return a.laser_returns[k].distance() == b.laser_returns[k].distance();
  }

  double delay(int k) const {
    return k / model_.lasersPerBlock() * model_.firing_s +
           k % model_.lasersPerBlock() * model_.laser_s;
  }

  bool add(const Return& raw, const LaserRay& ray, double azimuth_rad) {
    const double range_m = ray.range(raw.distance());
    if (raw.distance() == 0 || range_m < min_range_m_) return false;
    returns_.points.push_back(ray.pointAt(range_m, azimuth_rad));
    returns_.intensity.push_back(raw.intensity() * kByteIntensity);
    return true;
  }

  const VelodyneModel model_;
  const std::vector<LaserRay> rays_;
  const double min_range_m_;
  SensorReturns& returns_;
};

/** Of a recording that holds points and no packets. */
void takePoints(const CObservationVelodyneScan& scan, SensorReturns& returns) {
  const auto& cloud = scan.point_cloud;
  for (size_t i = 0; i < cloud.x.size(); ++i)
    returns.points.emplace_back(cloud.x[i], cloud.y[i], cloud.z[i]);
  if (cloud.intensity.size() == cloud.x.size())
    for (const uint8_t i : cloud.intensity) returns.intensity.push_back(i * kByteIntensity);
  if (cloud.timestamp.size() == cloud.x.size())
    for (const auto& stamp : cloud.timestamp)
      returns.time.push_back(
          static_cast<float>(mrpt::system::timeDifference(scan.timestamp, stamp)));
}

}  // namespace

SensorReturns returnsOf(const CObservationVelodyneScan& scan) {
  SensorReturns returns;
  returns.max_range_m = scan.maxRange;
  if (scan.scan_packets.empty()) {
    takePoints(scan, returns);
    return returns;
  }
  const auto times = packetTimes(scan.scan_packets);
  PacketReader reader(scan, returns);
  const size_t most = scan.scan_packets.size() * CObservationVelodyneScan::SCANS_PER_PACKET;
  for (auto* column : {&returns.intensity, &returns.time}) column->reserve(most);
  returns.points.reserve(most);
  for (size_t i = 0; i < scan.scan_packets.size(); ++i)
    reader.read(scan.scan_packets[i], times ? std::optional<double>((*times)[i]) : std::nullopt);
  return returns;
}

}  // namespace lamp
