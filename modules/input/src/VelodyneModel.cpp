#include "VelodyneModel.h"

#include <cmath>
#include <stdexcept>

namespace lamp {
namespace {

using mrpt::obs::CObservationVelodyneScan;
using mrpt::obs::VelodyneCalibration;

/** The last byte of a packet; of an HDL-64E it means something else. */
constexpr uint8_t kHdl32 = 0x21, kVlp16 = 0x22, kPuckHiRes = 0x24, kVlp32c = 0x28;

constexpr double degrees(double value) {
  return value * M_PI / 180.0;
}

/** Lasers fire in turn from a lower and an upper half, each from bottom to top. */
std::vector<VelodyneLaser> interleaved(int lasers, double lower_deg, double upper_deg,
                                       double step_deg) {
  std::vector<VelodyneLaser> result(static_cast<size_t>(lasers));
  for (int i = 0; i < lasers; ++i)
    result[i].elevation_rad = degrees((i % 2 ? upper_deg : lower_deg) + i / 2 * step_deg);
  return result;
}

/** VLP-16 User Manual 63-9243, chapter 9; the Puck Hi-Res differs in its angles only. */
VelodyneModel vlp16(bool high_resolution) {
  constexpr double kThird = 4.0 / 3.0;
  return {high_resolution ? interleaved(16, -10, 0.5 * kThird, kThird) : interleaved(16, -15, 1, 2),
          2, 55.296e-6, 2.304e-6};
}

/** HDL-32E User's Manual, Laser Firing Sequence and appendix E. */
VelodyneModel hdl32() {
  constexpr double kThird = 4.0 / 3.0;
  return {interleaved(32, -23 * kThird, -7 * kThird, kThird), 1, 46.08e-6, 1.152e-6};
}

/** HDL-64E S2 User's Manual: 1.33 million returns a second. Its two blocks of 32 lasers fire
 * together; the order within them is taken to be even. */
VelodyneModel hdl64() {
  return {std::vector<VelodyneLaser>(64), 1, 48e-6, 1.5e-6};
}

std::vector<VelodyneLaser> calibrated(const VelodyneCalibration& calibration) {
  std::vector<VelodyneLaser> lasers;
  for (const auto& laser : calibration.laser_corrections)
    lasers.push_back({std::atan2(laser.sinVertCorrection, laser.cosVertCorrection),
                      degrees(laser.azimuthCorrection), laser.distanceCorrection,
                      laser.verticalOffsetCorrection, laser.horizontalOffsetCorrection});
  return lasers;
}

VelodyneModel uncalibrated(uint8_t mark) {
  if (mark == kVlp16 || mark == kPuckHiRes) return vlp16(mark == kPuckHiRes);
  if (mark == kHdl32) return hdl32();
  throw std::runtime_error(
      "CObservationVelodyneScan without calibration of a lidar that is no "
      "VLP-16, Puck Hi-Res or HDL-32E: where its lasers point is not recorded");
}

}  // namespace

int VelodyneModel::lasersPerBlock() const {
  return CObservationVelodyneScan::SCANS_PER_BLOCK / firings_per_block;
}

VelodyneModel velodyneModel(const CObservationVelodyneScan& scan) {
  const size_t count = scan.calibration.laser_corrections.size();
  const uint8_t mark = scan.scan_packets.empty() ? 0 : scan.scan_packets[0].velodyne_model_ID;
  if (count != 64 && mark == kVlp32c)
    throw std::runtime_error("the packets of a VLP-32C cannot be read; record it as a point cloud");
  if (count == 0) return uncalibrated(mark);
  if (count != 16 && count != 32 && count != 64)
    throw std::runtime_error("CObservationVelodyneScan with a calibration of " +
                             std::to_string(count) + " lasers: neither 16, 32 nor 64");
  VelodyneModel model = count == 16 ? vlp16(false) : count == 32 ? hdl32() : hdl64();
  model.lasers = calibrated(scan.calibration);
  return model;
}

VelodyneModel velodyneModel(const std::string& name) {
  if (name == "VLP-16") return vlp16(false);
  if (name == "HDL-32E") return hdl32();
  throw std::runtime_error("the lidar model '" + name + "' is not known");
}

}  // namespace lamp
