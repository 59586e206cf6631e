#include "lamp/frontend/SweepGatherer.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cmath>

#include "lamp/input/ScanFromObservation.h"
#include "lamp/simulation/VelodyneObservation.h"
#include "lamp/simulation/World.h"

namespace lamp {
namespace {

constexpr double kDegree = M_PI / 180.0;

/** Points around the lidar, in the base frame. */
Scan ring(const Pose3& base_T_sensor, double begin_deg, double span_deg, int points = 40) {
  Scan scan;
  for (int i = 0; i < points; ++i) {
    const double a = (begin_deg + span_deg * i / points) * kDegree;
    scan.points.push_back(
        (base_T_sensor * Eigen::Vector3d(5 * std::cos(a), -5 * std::sin(a), 0.3)).cast<float>());
  }
  return scan;
}

Pose3 at(double yaw, double pitch, double roll) {
  return poseFromYawPitchRoll((Vector6d() << 0.2, 0, 0.5, yaw, pitch, roll).finished());
}

TEST(SweepGatherer, PiecesOfATurnAreOneScan) {
  SweepGatherer gatherer;
  const Pose3 mount = at(0.3, 0.6, 0);
  std::vector<int> begins;
  for (int i = 0; i < 80; ++i)  // 9.6 degrees each, like two packets of a VLP-16
    if (gatherer.begins(100 + 2.654e-3 * i, mount, ring(mount, 9.6 * i, 9.6))) begins.push_back(i);
  EXPECT_EQ(begins, (std::vector<int>{0, 38, 76}));
  EXPECT_FALSE(gatherer.wholeScans());
}

TEST(SweepGatherer, APieceThatIsMissingOrEmptyDoesNotMatter) {
  SweepGatherer gatherer;
  const Pose3 mount = at(0, 0, 0);
  std::vector<int> begins;
  for (int i = 0; i < 80; ++i) {
    if (i == 20 || i == 40) continue;
    const Scan piece = i == 10 ? Scan() : ring(mount, 9.6 * i, 9.6);
    if (gatherer.begins(100 + 2.654e-3 * i, mount, piece)) begins.push_back(i);
  }
  EXPECT_EQ(begins, (std::vector<int>{0, 38, 76}));
}

TEST(SweepGatherer, WholeSweepsAreNotWaitedFor) {
  SweepGatherer gatherer;
  const Pose3 mount = at(0, 0, 0);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(gatherer.wholeScans(), i >= 4) << i;
    EXPECT_TRUE(gatherer.begins(100 + 0.1 * i, mount, ring(mount, 3 * i, 360, 900)));
  }
}

TEST(SweepGatherer, SoAreThoseOfALimitedFieldOfView) {
  SweepGatherer gatherer;
  const Pose3 mount = at(1, 0, 0);
  for (int i = 0; i < 6; ++i)
    EXPECT_TRUE(gatherer.begins(100 + 0.1 * i, mount, ring(mount, -45, 90, 181)));
  EXPECT_TRUE(gatherer.wholeScans());
}

TEST(SweepGatherer, ATurningMountHasSeenAllAfterHalfATurn) {
  SweepGatherer gatherer;
  std::vector<int> begins;
  for (int i = 0; i < 900; ++i) {
    const double stamp = 100 + 2.654e-3 * i;
    const Pose3 mount = at(M_PI * (stamp - 100), 0, 80 * kDegree);
    if (gatherer.begins(stamp, mount, ring(mount, 9.6 * i, 9.6))) begins.push_back(i);
  }
  EXPECT_EQ(begins, (std::vector<int>{0, 377, 754})) << "a second each";
}

TEST(SweepGatherer, ANoddingLaserHasWhenItTurnsBack) {
  SweepGatherer gatherer;
  std::vector<int> begins;
  for (int i = 0; i < 100; ++i) {
    const int phase = i % 40;
    const Pose3 mount = at(0, 0.03 * (phase < 20 ? phase : 40 - phase), 0);
    if (gatherer.begins(100 + 0.025 * i, mount, ring(mount, -90, 180, 181))) begins.push_back(i);
  }
  EXPECT_EQ(begins, (std::vector<int>{0, 21, 41, 61, 81}));
}

/** How many of the observations of a simulated lidar at rest begin a scan. */
size_t scansOf(const std::string& model, double seconds, SweepGatherer& gatherer) {
  using namespace simulation;
  const World world = worldKind("demo").make(100, 0.3, 1);
  const RayCaster caster(world.mesh);
  const TrajectoryInterpolator truth({{100, Pose3::Identity()}, {110, Pose3::Identity()}});
  LidarOptions options;
  options.model = model;
  const Lidar lidar(options, caster);
  size_t scans = 0;
  for (int i = 0; i < 10 * seconds; ++i)
    for (const auto& observation :
         velodyneObservations(lidar.sweep(truth, 100 + 0.1 * i, 1), lidar, "a/b"))
      scans += gatherer.begins(mrpt::Clock::toDouble(observation->timestamp),
                               lidar.baseTSensor(mrpt::Clock::toDouble(observation->timestamp)),
                               *scanFromObservation(*observation, "b", {}));
  return scans;
}

TEST(SweepGatherer, SimulatedLidarsMakeTheScansTheyShould) {
  SweepGatherer spinning, mounted;
  EXPECT_EQ(scansOf("spinning", 1, spinning), 10u);
  EXPECT_TRUE(spinning.wholeScans());
  EXPECT_EQ(scansOf("rotating_mount", 3.5, mounted), 4u) << "half a turn of its mount each second";
  EXPECT_FALSE(mounted.wholeScans());
}

TEST(SweepGatherer, NoScanLastsTooLong) {
  SweepGatherer gatherer(0.5);
  const Pose3 mount = at(0, 0, 0);
  int scans = 0;
  for (int i = 0; i < 100; ++i) scans += gatherer.begins(100 + 0.1 * i, mount, Scan());
  EXPECT_EQ(scans, 20);
}

}  // namespace
}  // namespace lamp
