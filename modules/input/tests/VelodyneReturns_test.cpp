/** Packets made by hand, and recordings of MRPT's. */
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <array>
#include <cmath>
#include <cstring>

#include "RecordingTools.h"
#include "lamp/input/RawlogSource.h"
#include "lamp/input/ScanFromObservation.h"

namespace lamp {
namespace {

using namespace test;
using mrpt::obs::CObservationRotatingScan;
using mrpt::obs::CObservationVelodyneScan;

constexpr uint8_t kStrongest = 0x37, kDual = 0x39, kHdl32 = 0x21, kVlp16 = 0x22;
constexpr double kDegree = M_PI / 180.0;

struct Bytes {
  std::array<uint8_t, 1206> bytes{};

  void put(size_t at, uint32_t value, size_t count) {
    for (size_t i = 0; i < count; ++i) bytes[at + i] = static_cast<uint8_t>(value >> (8 * i));
  }
  void setBlock(size_t block, int azimuth, uint32_t header = 0xeeff) {
    put(100 * block, header, 2);
    put(100 * block + 2, static_cast<uint32_t>((azimuth + 36000) % 36000), 2);
  }
  void setReturn(size_t block, size_t place, double range_m, uint8_t intensity = 51) {
    put(100 * block + 4 + 3 * place, static_cast<uint32_t>(std::lround(range_m / 0.002)), 2);
    bytes[100 * block + 6 + 3 * place] = intensity;
  }
  void finish(uint32_t time_us, uint8_t mode, uint8_t model) {
    put(1200, time_us, 4);
    bytes[1204] = mode;
    bytes[1205] = model;
  }
};

/** Azimuths grow by 40 hundredths of a degree a block; nothing is returned yet. */
Bytes emptyPacket(uint32_t time_us, uint8_t mode, uint8_t model, int first_azimuth = 1000) {
  Bytes packet;
  for (int i = 0; i < 12; ++i)
    packet.setBlock(static_cast<size_t>(i), first_azimuth + 40 * (mode == kDual ? i / 2 : i));
  packet.finish(time_us, mode, model);
  return packet;
}

void fill(Bytes& packet, double range_m) {
  for (size_t block = 0; block < 12; ++block)
    for (size_t place = 0; place < 32; ++place) packet.setReturn(block, place, range_m);
}

CObservationVelodyneScan observation(const std::vector<Bytes>& packets) {
  CObservationVelodyneScan scan;
  scan.timestamp = mrpt::Clock::fromDouble(1000);
  for (const Bytes& packet : packets) {
    CObservationVelodyneScan::TVelodyneRawPacket raw;
    static_assert(sizeof raw == sizeof packet.bytes);
    std::memcpy(static_cast<void*>(&raw), packet.bytes.data(), sizeof raw);
    scan.scan_packets.push_back(raw);
  }
  return scan;
}

Scan read(const mrpt::obs::CObservation& observation) {
  const auto scan = scanFromObservation(observation, "lidar", {});
  EXPECT_TRUE(scan);
  return *scan;
}

Eigen::Vector3f direction(double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg * kDegree, e = elevation_deg * kDegree;
  return Eigen::Vector3d(std::cos(e) * std::cos(a), -std::cos(e) * std::sin(a), std::sin(e))
      .cast<float>();
}

void expectSeen(const Eigen::Vector3f& point, double range_m, double azimuth_deg,
                double elevation_deg) {
  EXPECT_LT((point - float(range_m) * direction(azimuth_deg, elevation_deg)).norm(), 1e-4 * range_m)
      << point.transpose();
}

TEST(VelodyneReturns, ABlockOfAVlp16IsTwoFirings) {
  Bytes packet = emptyPacket(5, kStrongest, kVlp16);
  packet.setReturn(3, 0, 10);
  packet.setReturn(3, 16 + 2, 20, 255);
  const Scan scan = read(observation({packet}));
  ASSERT_EQ(scan.size(), 2u);
  ASSERT_EQ(scan.time.size(), 2u);
  expectSeen(scan.points[0], 10, 11.2, -15);
  EXPECT_NEAR(scan.time[0], 3 * 110.592e-6, 1e-9);
  const double after_us = 55.296 + 2 * 2.304;
  expectSeen(scan.points[1], 20, 11.2 + 0.4 * after_us / 110.592, -13);
  EXPECT_NEAR(scan.time[1], 3 * 110.592e-6 + 1e-6 * after_us, 1e-9);
  EXPECT_FLOAT_EQ(scan.intensity[0], 51 / 255.0f);
  EXPECT_FLOAT_EQ(scan.intensity[1], 1);
}

TEST(VelodyneReturns, NoneIsLeftOut) {
  Bytes first = emptyPacket(0, kStrongest, kVlp16);
  Bytes second = emptyPacket(1327, kStrongest, kVlp16, 1480);
  fill(first, 5);
  fill(second, 5);
  const Scan scan = read(observation({first, second}));
  ASSERT_EQ(scan.size(), 2u * 12 * 32);
  for (size_t i = 1; i < scan.size(); ++i) EXPECT_GT(scan.time[i], scan.time[i - 1]);
  EXPECT_NEAR(scan.time[384], 1327e-6, 1e-9) << "by the packet's clock";
}

TEST(VelodyneReturns, OfTwoReturnsOfARayEqualOnesAreOne) {
  Bytes packet = emptyPacket(0, kDual, kVlp16);
  for (const size_t block : {4, 5}) packet.setReturn(block, 7, 12);
  packet.setReturn(4, 8, 30);
  packet.setReturn(5, 8, 25);
  const Scan scan = read(observation({packet}));
  ASSERT_EQ(scan.size(), 3u);
  expectSeen(scan.points[0], 12, 10.8 + 0.4 * 7 * 2.304 / 110.592, 7);
  EXPECT_NEAR(scan.points[1].norm(), 30, 1e-3);
  EXPECT_NEAR(scan.points[2].norm(), 25, 1e-3);
  EXPECT_NEAR(scan.time[1], 2 * 110.592e-6 + 8 * 2.304e-6, 1e-9) << "two blocks are one firing";
  EXPECT_EQ(scan.time[2], scan.time[1]);
}

TEST(VelodyneReturns, ABlockOfAnHdl32IsOneFiring) {
  Bytes packet = emptyPacket(0, kStrongest, kHdl32);
  packet.setReturn(2, 0, 10);
  packet.setReturn(2, 31, 10);
  const Scan scan = read(observation({packet}));
  ASSERT_EQ(scan.size(), 2u);
  expectSeen(scan.points[0], 10, 10.8, -92.0 / 3);
  expectSeen(scan.points[1], 10, 10.8 + 0.4 * 31 * 1.152 / 46.08, 32.0 / 3);
  EXPECT_NEAR(scan.time[1], 2 * 46.08e-6 + 31 * 1.152e-6, 1e-9);
}

mrpt::obs::VelodyneCalibration calibration64() {
  mrpt::obs::VelodyneCalibration calibration;
  calibration.laser_corrections.resize(64);
  auto& laser = calibration.laser_corrections[32 + 5];
  laser.azimuthCorrection = 4;
  laser.sinVertCorrection = std::sin(-20 * kDegree);
  laser.cosVertCorrection = std::cos(-20 * kDegree);
  laser.distanceCorrection = 1.5;
  laser.verticalOffsetCorrection = 0.2;
  laser.horizontalOffsetCorrection = 0.03;
  return calibration;
}

/** Upper and lower bank by turns, both with one azimuth. */
Bytes packet64(int blocks_of_one_azimuth) {
  Bytes packet;
  for (int i = 0; i < 12; ++i)
    packet.setBlock(static_cast<size_t>(i), 9000 + 17 * (i / blocks_of_one_azimuth),
                    i % 2 ? 0xddff : 0xeeff);
  packet.finish(0, 7, 0x28);  // a status, not the model
  return packet;
}

TEST(VelodyneReturns, AnHdl64HasTwoBanksAndOffsets) {
  Bytes packet = packet64(2);
  packet.setReturn(6, 0, 8);
  packet.setReturn(7, 5, 10);
  auto scan = observation({packet});
  scan.calibration = calibration64();
  const Scan seen = read(scan);
  ASSERT_EQ(seen.size(), 2u);
  expectSeen(seen.points[0], 8, 90.51, 0);
  EXPECT_NEAR(seen.time[0], 3 * 48e-6, 1e-9);
  EXPECT_NEAR(seen.time[1], 3 * 48e-6 + 5 * 1.5e-6, 1e-9);
  // The ray starts beside the axes: 0.2 m across it in the vertical plane, 0.03 m to the left.
  const double azimuth = 90.51 - 4 + 0.17 * 5 * 1.5 / 48;
  const Eigen::Vector3f left = -direction(azimuth + 90, 0), up = direction(azimuth, -20 + 90);
  const Eigen::Vector3f expected = 11.5f * direction(azimuth, -20) + 0.2f * up + 0.03f * left;
  EXPECT_LT((seen.points[1] - expected).norm(), 1e-3) << seen.points[1].transpose();
}

TEST(VelodyneReturns, AnHdl64InDualModeRepeatsBothBanks) {
  Bytes packet = packet64(4);
  for (const size_t block : {5, 7}) packet.setReturn(block, 5, 10);
  packet.setReturn(7, 6, 10);
  auto scan = observation({packet});
  scan.calibration = calibration64();
  const Scan seen = read(scan);
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_NEAR(seen.time[0], 48e-6 + 5 * 1.5e-6, 1e-9);
}

TEST(VelodyneReturns, WithoutCalibrationOtherModelsAreRefused) {
  for (const uint8_t model : {uint8_t{0}, uint8_t{0x28}})
    EXPECT_THROW(read(observation({emptyPacket(0, kStrongest, model)})), std::runtime_error);
}

TEST(VelodyneReturns, APacketClockPassesTheHour) {
  Bytes first = emptyPacket(3'599'999'500, kStrongest, kVlp16);
  Bytes second = emptyPacket(827, kStrongest, kVlp16);
  second.setReturn(0, 0, 5);
  const Scan scan = read(observation({first, second}));
  ASSERT_EQ(scan.time.size(), 1u);
  EXPECT_NEAR(scan.time[0], 1327e-6, 1e-9);
}

TEST(VelodyneReturns, WithoutAClockThereAreNoTimes) {
  Bytes packet = emptyPacket(0, kStrongest, kVlp16);
  fill(packet, 5);
  const Scan scan = read(observation({packet, packet}));
  EXPECT_EQ(scan.size(), 768u);
  EXPECT_FALSE(scan.hasTimes());
}

TEST(VelodyneReturns, AzimuthsAreNotSpreadOverAGapInTheFieldOfView) {
  Bytes packet = emptyPacket(0, kStrongest, kVlp16);
  for (size_t block = 6; block < 12; ++block)
    packet.setBlock(block, 30000 + 40 * static_cast<int>(block));
  packet.setReturn(5, 16, 10);
  const Scan scan = read(observation({packet}));
  ASSERT_EQ(scan.size(), 1u);
  expectSeen(scan.points[0], 10, 12.2, -15);
}

TEST(VelodyneReturns, PointsWithoutPacketsKeepTheirStamps) {
  CObservationVelodyneScan scan;
  scan.timestamp = mrpt::Clock::fromDouble(1000);
  scan.point_cloud.x = {5, 6};
  scan.point_cloud.y = scan.point_cloud.z = {1, 1};
  scan.point_cloud.intensity = {0, 255};
  scan.point_cloud.timestamp = {mrpt::Clock::fromDouble(1000.01), mrpt::Clock::fromDouble(1000.05)};
  const Scan seen = read(scan);
  ASSERT_EQ(seen.time.size(), 2u);
  EXPECT_NEAR(seen.time[1], 0.05, 1e-6);
}

TEST(VelodyneReturns, ASweepOfMoreThanASecondIsRefused) {
  Bytes first = emptyPacket(0, kStrongest, kVlp16);
  Bytes second = emptyPacket(1'100'000, kStrongest, kVlp16);
  fill(first, 5);
  fill(second, 5);
  EXPECT_THROW(read(observation({first, second})), std::runtime_error);

  CObservationRotatingScan rotating;
  rotating.rowCount = 1;
  rotating.columnCount = 3;
  rotating.rangeResolution = 0.01;
  rotating.rangeImage.setConstant(1, 3, uint16_t{500});
  rotating.sweepDuration = 0.1;
  EXPECT_EQ(read(rotating).time, (std::vector<float>{0, 0.05f, 0.1f}));
  rotating.sweepDuration = 100;  // milliseconds
  EXPECT_THROW(read(rotating), std::runtime_error);
}

template <class T>
std::shared_ptr<T> firstObservation(const std::string& path) {
  RobotTable table;
  RawlogSource source({path}, {}, table);
  return std::dynamic_pointer_cast<T>(source.next()->observation);
}

/** What MRPT makes of the packets: of each block, the first firing. */
CObservationVelodyneScan::TPointCloud readByMrpt(CObservationVelodyneScan scan) {
  CObservationVelodyneScan::TGeneratePointCloudParameters parameters;
  parameters.minDistance = 0;
  scan.generatePointCloud(parameters);
  return scan.point_cloud;
}

TEST(VelodyneReturns, RecordedSweepIsWhatMrptReadsAndAsMuchAgain) {
  const std::string path = mrptRecording("test_velodyne_VLP16.rawlog");
  if (path.empty()) GTEST_SKIP() << "mrpt-common's recordings are not installed";
  const auto recorded = firstObservation<CObservationVelodyneScan>(path);
  const Scan scan = read(*recorded);
  EXPECT_EQ(scan.size(), 11305u + 11286u) << "all ranges in the packets that are not zero";
  const auto mrpt = readByMrpt(*recorded);
  ASSERT_EQ(mrpt.size(), 11305u);
  size_t i = 0;
  for (size_t k = 0; k < mrpt.size(); ++k, ++i) {
    const Eigen::Vector3f expected(mrpt.x[k], mrpt.y[k], mrpt.z[k] + 0.09f);
    // MRPT rounds azimuths to hundredths of a degree, twice.
    const float tolerance = 0.02f * float(kDegree) * expected.norm();
    while (i < scan.size() && (scan.points[i] - expected).norm() > tolerance) ++i;
  }
  EXPECT_LE(i, scan.size()) << "each of MRPT's, in its order";
  EXPECT_NEAR(scan.time.back(), 0.0995, 0.0003);
}

TEST(VelodyneReturns, ARotatingScanHasTheFirstFiringsWithTheirTimes) {
  const std::string packets = mrptRecording("test_velodyne_VLP16.rawlog");
  const std::string image = mrptRecording("rot_scan_velodyne.rawlog");
  if (packets.empty() || image.empty())
    GTEST_SKIP() << "mrpt-common's recordings are not installed";
  const Scan full = read(*firstObservation<CObservationVelodyneScan>(packets));
  const Scan half = read(*firstObservation<CObservationRotatingScan>(image));
  ASSERT_EQ(half.size(), 11305u);
  ASSERT_EQ(half.time.size(), 11305u);
  // Both by time: the image lies row by row, and has one rate of turning for the whole sweep.
  std::vector<std::pair<float, size_t>> order;
  for (size_t i = 0; i < half.size(); ++i) order.emplace_back(half.time[i], i);
  std::sort(order.begin(), order.end());
  size_t k = 0;
  for (const auto& [time, i] : order) {
    while (k < full.size() && full.time[k] < time - 2.5e-6f) ++k;
    ASSERT_LT(k, full.size());
    EXPECT_NEAR(full.time[k], time, 2.5e-6);
    EXPECT_LT((full.points[k] - half.points[i]).norm(), 0.2 * kDegree * half.points[i].norm());
    ++k;
  }
}

}  // namespace
}  // namespace lamp
