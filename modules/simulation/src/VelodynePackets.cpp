#include "VelodynePackets.h"

#include <algorithm>
#include <cmath>

namespace lamp::simulation {
namespace {

constexpr size_t kBlockSize = 100, kBlockHeader = 4, kReturnSize = 3;
constexpr size_t kTimeAt = 1200, kReturnModeAt = 1204, kModelAt = 1205;
constexpr uint8_t kStrongestReturn = 0x37, kVlp16 = 0x22;
constexpr double kRangeUnit_m = 0.002;
constexpr int64_t kHour_us = 3'600'000'000;

void putLittleEndian(uint8_t* at, uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) at[i] = static_cast<uint8_t>(value >> (8 * i));
}

/** Microseconds since the top of the hour, counted from the first packet's so that differences
 * between packets are right to a microsecond. */
uint32_t packetTime(double begin_stamp, double delay_s) {
  const int64_t begin_us = std::llround(std::fmod(begin_stamp, 3600.0) * 1e6);
  return static_cast<uint32_t>((begin_us + std::llround(delay_s * 1e6)) % kHour_us);
}

void writeBlockHeader(uint8_t* block, double azimuth_rad) {
  const auto hundredths = std::llround(azimuth_rad * 180.0 / M_PI * 100.0) % 36000;
  putLittleEndian(block, 0xeeff, 2);
  putLittleEndian(block + 2, static_cast<uint32_t>(hundredths), 2);
}

VelodynePacket emptyPacket(int first_block, double begin_stamp, const FiringPattern& pattern) {
  VelodynePacket packet;
  packet.delay_s = pattern.delay(first_block * pattern.sequencesPerBlock(), 0);
  for (int i = 0; i < VelodynePacket::kBlocks; ++i) {
    const int sequence = (first_block + i) * pattern.sequencesPerBlock();
    writeBlockHeader(packet.bytes.data() + i * kBlockSize, pattern.azimuth(sequence, 0));
  }
  putLittleEndian(packet.bytes.data() + kTimeAt, packetTime(begin_stamp, packet.delay_s), 4);
  packet.bytes[kReturnModeAt] = kStrongestReturn;
  packet.bytes[kModelAt] = kVlp16;
  return packet;
}

void writeReturn(const LidarReturn& r, uint8_t* at) {
  const auto units = std::clamp<long long>(std::llround(r.range_m / kRangeUnit_m), 1, 65535);
  putLittleEndian(at, static_cast<uint32_t>(units), 2);
  at[2] = static_cast<uint8_t>(std::lround(255.0f * std::clamp(r.intensity, 0.0f, 1.0f)));
}

}  // namespace

std::vector<VelodynePacket> velodynePackets(const LidarSweep& sweep, const FiringPattern& pattern) {
  const int per_block = pattern.sequencesPerBlock();
  const int blocks = (pattern.sequences() + per_block - 1) / per_block;
  std::vector<VelodynePacket> packets;
  for (int block = 0; block < blocks; block += VelodynePacket::kBlocks)
    packets.push_back(emptyPacket(block, sweep.begin_stamp, pattern));
  for (const LidarReturn& r : sweep.returns) {
    const int block = r.sequence / per_block;
    const int place = r.sequence % per_block * FiringPattern::kLasers + r.laser;
    writeReturn(r, packets[block / VelodynePacket::kBlocks].bytes.data() +
                       block % VelodynePacket::kBlocks * kBlockSize + kBlockHeader +
                       place * kReturnSize);
  }
  return packets;
}

}  // namespace lamp::simulation
