#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lamp/simulation/Lidar.h"

namespace lamp::simulation {

/** The payload of a data packet, byte for byte (VLP-16 manual, 63-9243, chapter 9). */
struct VelodynePacket {
  static constexpr int kBlocks = 12;
  std::array<uint8_t, 1206> bytes{};
  double delay_s = 0;  ///< of its first firing, since the begin of the sweep
};

/** All packets of a sweep, in order; what the last one does not need stays without returns. */
std::vector<VelodynePacket> velodynePackets(const LidarSweep& sweep, const FiringPattern& pattern);

}  // namespace lamp::simulation
