#include "lamp/simulation/VelodyneObservation.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cmath>

#include "TestMesh.h"
#include "TestMotion.h"

namespace lamp::simulation {
namespace {

using namespace test;
using mrpt::obs::CObservationVelodyneScan;

/** What MRPT makes of the packets. */
CObservationVelodyneScan::TPointCloud decoded(CObservationVelodyneScan scan) {
  CObservationVelodyneScan::TGeneratePointCloudParameters parameters;
  parameters.minDistance = 0;
  parameters.generatePerPointTimestamp = true;
  scan.generatePointCloud(parameters);
  return scan.point_cloud;
}

Eigen::Vector3f pointOf(const CObservationVelodyneScan::TPointCloud& cloud, size_t i) {
  return {cloud.x[i], cloud.y[i], cloud.z[i]};
}

/** Half a unit of range, and two hundredths of a degree across: MRPT's rounding of the azimuth of
 * block and laser, and its table of sines. */
void expectWithinQuantisation(const Eigen::Vector3f& point, const LidarReturn& r) {
  EXPECT_NEAR(point.norm(), r.range_m, 0.00101);
  EXPECT_LT((point.normalized() - r.point.normalized()).norm(), 0.02 * M_PI / 180.0);
}

struct World {
  Mesh mesh = room({20, 9, 3}, Material::kRock);
  RayCaster caster{mesh};
  TrajectoryInterpolator truth = steady(4, (Vector6d() << 1, 0, 0, 0, 0, 0.5).finished());
};

TEST(VelodyneObservation, MrptDecodesWhatTheLidarSaw) {
  const World world;
  for (const int steps : {900, 720, 1024, 13}) {
    LidarOptions options;
    options.azimuth_steps = steps;
    const Lidar lidar(options, world.caster);
    const auto sweep = lidar.sweep(world.truth, kBegin + 1, 5);
    const auto observations = velodyneObservations(sweep, lidar, "husky1/lidar");
    ASSERT_EQ(observations.size(), 1u);
    const auto cloud = decoded(*observations[0]);
    ASSERT_EQ(cloud.size(), sweep.returns.size()) << steps;
    const double packet_s = 12 * lidar.pattern().delay(1, 0);
    for (size_t i = 0; i < cloud.size(); ++i) {
      const LidarReturn& r = sweep.returns[i];
      expectWithinQuantisation(pointOf(cloud, i), r);
      EXPECT_EQ(cloud.laser_id[i], r.laser);
      EXPECT_NEAR(cloud.intensity[i] / 255.0, r.intensity, 0.5 / 255 + 1e-6);
      const double since_packet = r.stamp - mrpt::Clock::toDouble(cloud.timestamp[i]);
      EXPECT_GT(since_packet, -2e-6);
      EXPECT_LT(since_packet, packet_s + 2e-6) << "MRPT stamps by packet";
    }
  }
}

TEST(VelodyneObservation, CarriesLabelStampPoseAndLimits) {
  const World world;
  LidarOptions options;
  options.pose = {0.1, 0.2, 0.3, 90, 10, 5};
  const Lidar lidar(options, world.caster);
  const auto scan =
      velodyneObservations(lidar.sweep(world.truth, kBegin + 1, 5), lidar, "husky1/top")[0];
  EXPECT_EQ(scan->sensorLabel, "husky1/top");
  EXPECT_NEAR(mrpt::Clock::toDouble(scan->timestamp), kBegin + 1, 1e-6);
  EXPECT_EQ(scan->minRange, options.min_range_m);
  EXPECT_EQ(scan->maxRange, options.max_range_m);
  EXPECT_EQ(scan->calibration.laser_corrections.size(), 16u);
  EXPECT_EQ(scan->scan_packets.size(), 75u);
  const double degree = M_PI / 180.0;
  const mrpt::poses::CPose3D expected(0.1, 0.2, 0.3, 90 * degree, 10 * degree, 5 * degree);
  EXPECT_LT(scan->sensorPose.distanceEuclidean6D(expected), 1e-9);
}

TEST(VelodyneObservation, SurvivesTheTopOfTheHour) {
  const World world;
  const Lidar lidar(LidarOptions(), world.caster);
  const double stamp = 3600.0 * 472222 - 0.04;  // the hour ends amid the sweep
  const auto sweep = lidar.sweep(world.truth, stamp, 5);
  const auto scan = velodyneObservations(sweep, lidar, "a/b")[0];
  EXPECT_GT(scan->scan_packets.front().gps_timestamp(), 3'599'000'000u);
  EXPECT_LT(scan->scan_packets.back().gps_timestamp(), 1'000'000u);
  const auto cloud = decoded(*scan);
  ASSERT_EQ(cloud.size(), sweep.returns.size());
  for (size_t i = 0; i < cloud.size(); ++i)
    EXPECT_NEAR(mrpt::Clock::toDouble(cloud.timestamp[i]), sweep.returns[i].stamp, 1.4e-3);
}

TEST(VelodyneObservation, OfFullPacketsMrptReadsEverySecondSequence) {
  const World world;
  LidarOptions options;
  options.azimuth_steps = 1800;
  options.sequences_per_block = 2;
  const Lidar lidar(options, world.caster);
  const auto sweep = lidar.sweep(world.truth, kBegin + 1, 5);
  const auto scan = velodyneObservations(sweep, lidar, "a/b")[0];
  EXPECT_EQ(scan->scan_packets.size(), 75u);
  std::vector<const LidarReturn*> even;
  for (const LidarReturn& r : sweep.returns) {
    if (r.sequence % 2 == 0) even.push_back(&r);
    const int block = r.sequence / 2;
    const auto& raw = scan->scan_packets[block / 12].blocks[block % 12];
    EXPECT_NEAR(raw.laser_returns[r.sequence % 2 * 16 + r.laser].distance() * 0.002, r.range_m,
                0.00101)
        << "but all are there";
  }
  const auto cloud = decoded(*scan);
  ASSERT_EQ(cloud.size(), even.size());
  for (size_t i = 0; i < cloud.size(); ++i) expectWithinQuantisation(pointOf(cloud, i), *even[i]);
}

TEST(VelodyneObservation, ARotatingMountComesInShortPieces) {
  const World world;
  LidarOptions options;
  options.model = "rotating_mount";
  options.pose = {0.1, 0, 0.4, 0, 45, 0};
  const Lidar lidar(options, world.caster);
  const auto sweep = lidar.sweep(world.truth, kBegin + 1, 5);
  const auto observations = velodyneObservations(sweep, lidar, "drone/lidar");
  EXPECT_EQ(observations.size(), 38u);
  size_t next = 0;
  for (const auto& scan : observations) {
    EXPECT_LE(scan->scan_packets.size(), 2u);
    const auto cloud = decoded(*scan);
    for (size_t i = 0; i < cloud.size(); ++i, ++next) {
      ASSERT_LT(next, sweep.returns.size());
      const LidarReturn& r = sweep.returns[next];
      expectWithinQuantisation(pointOf(cloud, i), r);
      EXPECT_GE(r.stamp, mrpt::Clock::toDouble(scan->timestamp) - 2e-6);
      const auto p = scan->sensorPose.composePoint({r.point.x(), r.point.y(), r.point.z()});
      const Eigen::Vector3d expected = lidar.baseTSensor(r.stamp) * r.point.cast<double>();
      // Half of two packets' time at half a turn per second is a quarter of a degree.
      EXPECT_LT((Eigen::Vector3d(p.x, p.y, p.z) - expected).norm(), r.range_m * 0.26 * M_PI / 180);
    }
  }
  EXPECT_EQ(next, sweep.returns.size());
}

TEST(VelodyneObservation, ASweepWithoutReturnsIsStillASweep) {
  const World world;
  const Lidar lidar(LidarOptions(), world.caster);
  const auto scan = velodyneObservations({kBegin, 0.1, {}}, lidar, "a/b")[0];
  EXPECT_EQ(scan->scan_packets.size(), 75u);
  EXPECT_EQ(decoded(*scan).size(), 0u);
}

}  // namespace
}  // namespace lamp::simulation
