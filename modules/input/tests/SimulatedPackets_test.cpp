/** Packets of simulated lidars, of which the direction and the time of each return are known. */
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include "lamp/input/ScanFromObservation.h"
#include "lamp/simulation/VelodyneObservation.h"
#include "lamp/simulation/World.h"

namespace lamp {
namespace {

using namespace simulation;

constexpr double kBegin = 1.6e9;

struct Demo {
  World world = worldKind("demo").make(100, 0.3, 1);
  RayCaster caster{world.mesh};
  TrajectoryInterpolator truth{{{kBegin, Pose3::Identity()}, {kBegin + 9, Pose3::Identity()}}};
};

/** \return how many returns were compared. */
size_t compare(const Lidar& lidar, const TrajectoryInterpolator& truth) {
  const LidarSweep sweep = lidar.sweep(truth, kBegin + 1, 5);
  size_t next = 0;
  for (const auto& observation : velodyneObservations(sweep, lidar, "robot/lidar")) {
    const auto scan = scanFromObservation(*observation, "lidar", {});
    const double stamp = mrpt::Clock::toDouble(observation->timestamp);
    const mrpt::poses::CPose3D& sensor = observation->sensorPose;
    for (size_t i = 0; i < scan->size(); ++i, ++next) {
      const LidarReturn& r = sweep.returns.at(next);
      const auto p = sensor.composePoint({r.point.x(), r.point.y(), r.point.z()});
      const Eigen::Vector3f expected = Eigen::Vector3d(p.x, p.y, p.z).cast<float>();
      // A unit of range is 2 mm, one of azimuth 0.01 degrees.
      EXPECT_LT((scan->points[i] - expected).norm(), 0.0011 + 2e-4 * r.range_m) << next;
      EXPECT_NEAR(stamp + scan->time[i], r.stamp, 10e-6) << next;
      if (testing::Test::HasFailure()) return next;
    }
  }
  EXPECT_EQ(next, sweep.returns.size());
  return next;
}

TEST(SimulatedPackets, AllReturnsAreReadWithTheirTimes) {
  const Demo demo;
  LidarOptions options;
  EXPECT_GT(compare(Lidar(options, demo.caster), demo.truth), 10000u);
  options.azimuth_steps = 1800;  // all places of a block are in use
  options.sequences_per_block = 2;
  EXPECT_GT(compare(Lidar(options, demo.caster), demo.truth), 20000u);
}

TEST(SimulatedPackets, SoAreThoseOfALidarOnARotatingMount) {
  const Demo demo;
  LidarOptions options;
  options.model = "rotating_mount";
  EXPECT_GT(compare(Lidar(options, demo.caster), demo.truth), 10000u);
}

}  // namespace
}  // namespace lamp
