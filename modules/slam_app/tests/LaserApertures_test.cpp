#include "LaserApertures.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <cmath>

#include "TemporaryFolder.h"
#include "TestTeam.h"
#include "lamp/core/MrptFile.h"

namespace lamp {
namespace {

using namespace test;

constexpr double kDegree = M_PI / 180.0;
const std::atomic<bool> kNot{false}, kInterrupted{true};

/** What a laser of 180 degrees sees of a room, turned by `yaw`. */
mrpt::obs::CObservation2DRangeScan scanAt(double yaw) {
  constexpr size_t kBeams = 181;
  mrpt::obs::CObservation2DRangeScan scan;
  scan.aperture = static_cast<float>(M_PI);
  scan.maxRange = 30;
  scan.sensorLabel = "laser";
  scan.resizeScan(kBeams);
  for (size_t i = 0; i < kBeams; ++i) {
    const double angle = yaw + (static_cast<double>(i) - 90) * kDegree;
    const double x = std::cos(angle), y = std::sin(angle);
    double range = std::min(x > 0 ? 4 / x : -3 / x, y > 0 ? 2.5 / y : -6 / y);
    if (x > 0.3 && y > 0.1) range = std::min(range, 1.8);  // a cupboard
    scan.setScanRange(i, static_cast<float>(range));
    scan.setScanRangeValidity(i, true);
  }
  return scan;
}

/** A robot that turns on the spot, in a rawlog; its laser's field of view is recorded as this. */
SlamConfig turningRobot(double recorded_deg) {
  const std::string path = freshFolder() + "/robot.rawlog";
  writeMrptFile(path, [&](const MrptSink& sink) {
    for (int i = 0; i < 150; ++i) {
      const double yaw = 5 * i * kDegree;
      mrpt::obs::CObservationOdometry odometry;
      odometry.sensorLabel = "wheels";
      odometry.odometry = mrpt::poses::CPose2D(0, 0, yaw);
      auto scan = scanAt(yaw);
      scan.aperture = static_cast<float>(recorded_deg * kDegree);
      odometry.timestamp = scan.timestamp = mrpt::Clock::fromDouble(1.6e9 + 0.2 * i);
      sink(odometry);
      sink(scan);
    }
  });
  SlamConfig config = configFrom("");
  config.input.rawlogs = {path};
  return config;
}

TEST(LaserApertures, AreMeasuredWhereTheyAreRecordedWrongly) {
  const auto found = measureApertures(turningRobot(90), kNot);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_DOUBLE_EQ(found.begin()->second.corrected_deg, 180);
  EXPECT_TRUE(measureApertures(turningRobot(180), kNot).empty());
}

TEST(LaserApertures, AreNotMeasuredWhereTheUserSaysWhatTheyAre) {
  SlamConfig config = turningRobot(90);
  config.frontend.scan.laser_aperture_deg = 180;
  EXPECT_TRUE(measureApertures(config, kNot).empty());
}

TEST(LaserApertures, AnInterruptEndsTheFirstLook) {
  EXPECT_TRUE(measureApertures(turningRobot(90), kInterrupted).empty());
}

}  // namespace
}  // namespace lamp
