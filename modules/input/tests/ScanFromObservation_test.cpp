#include "lamp/input/ScanFromObservation.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cmath>
#include <limits>

#include "RecordingTools.h"
#include "lamp/observations/CObservationTimedPoints.h"

namespace lamp {
namespace {

using namespace test;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

mrpt::obs::CObservation2DRangeScan laser(size_t rays, float range) {
  mrpt::obs::CObservation2DRangeScan o;
  o.aperture = static_cast<float>(M_PI);
  o.maxRange = 50;
  o.resizeScanAndAssign(rays, range, true);
  return o;
}

void expectPoint(const Eigen::Vector3f& p, float x, float y, float z, float tolerance = 1e-5f) {
  EXPECT_LT((p - Eigen::Vector3f(x, y, z)).norm(), tolerance) << p.transpose();
}

TEST(ScanFromObservation, CloudMovesToTheBaseFrame) {
  auto o = cloud(1, "lidar", 1);
  o->sensorPose = mrpt::poses::CPose3D(10, 20, 30, M_PI / 2, 0, 0);
  const auto scan = scanFromObservation(*o, "lidar", {});
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->size(), 1u);
  expectPoint(scan->points[0], 10 - 2, 20 + 1, 30 + 3);
  ASSERT_EQ(scan->sensors.size(), 1u);
  EXPECT_EQ(scan->sensors[0].label, "lidar");
  EXPECT_TRUE(scan->sensors[0].position.isApprox(Eigen::Vector3d(10, 20, 30)));
  EXPECT_EQ(scan->sensor, std::vector<uint8_t>(1, 0));
  EXPECT_FALSE(scan->hasIntensity());
}

TEST(ScanFromObservation, TheRobotsOwnBodyIsLeftOut) {
  auto map = mrpt::maps::CSimplePointsMap::Create();
  for (const float x : {-2.0f, -0.6f, 0.0f, 0.6f, 2.0f}) map->insertPoint(x, 0.1f, -0.3f);
  map->insertPoint(0.2f, 0.1f, 0.3f);  // above it
  auto o = cloud(1, "lidar", 0);
  o->pointcloud = map;
  o->sensorPose = mrpt::poses::CPose3D(0.2, 0, 0.8, 0, 0, 0);
  EXPECT_EQ(scanFromObservation(*o, "lidar", {})->size(), 6u);
  ScanOptions options;
  options.body_box = {0.5, 0.35, 0.9, -0.5, -0.35, 0};  // corners in any order, base frame
  const auto scan = scanFromObservation(*o, "lidar", options);
  ASSERT_EQ(scan->size(), 4u);
  expectPoint(scan->points[0], -1.8f, 0.1f, 0.5f);
  expectPoint(scan->points[1], 0.8f, 0.1f, 0.5f);
  expectPoint(scan->points[2], 2.2f, 0.1f, 0.5f);
  expectPoint(scan->points[3], 0.4f, 0.1f, 1.1f);
}

TEST(ScanFromObservation, TheTiltOfALaserIsThatOfItsPlane) {
  auto o = laser(3, 5);
  for (const double degrees : {0.0, 1.0, 25.0, 90.0}) {
    const double angle = degrees * M_PI / 180;
    for (const double upside_down : {0.0, M_PI})
      for (const double yaw : {0.0, 2.0}) {
        o.sensorPose = mrpt::poses::CPose3D(0, 0, 1, yaw, angle, upside_down);
        EXPECT_NEAR(laserTilt(o), angle, 1e-6) << degrees;
        EXPECT_EQ(isPlanarLaser(o), degrees < 2);
      }
  }
}

TEST(ScanFromObservation, IntensityStaysWithItsPoint) {
  auto map = mrpt::maps::CPointsMapXYZI::Create();
  map->insertPointRGB(0, 0, 0, 0.9f, 0, 0);  // a missing return
  map->insertPointRGB(1, 2, 3, 0.25f, 0, 0);
  auto o = cloud(1, "lidar", 0);
  o->pointcloud = map;
  const auto scan = scanFromObservation(*o, "lidar", {});
  ASSERT_EQ(scan->size(), 1u);
  EXPECT_EQ(scan->intensity, std::vector<float>(1, 0.25f));
}

TEST(ScanFromObservation, TimedPointsKeepTheirTimes) {
  CObservationTimedPoints o;
  o.x = {0, 1, 2};
  o.y = o.z = {0, 0, 0};
  o.time = {kNan, -0.02f, 0.03f};
  const auto scan = scanFromObservation(o, "lidar", {});
  ASSERT_TRUE(scan && isLidar(o));
  EXPECT_EQ(scan->time, (std::vector<float>{-0.02f, 0.03f})) << "without the missing return";
  EXPECT_FALSE(scan->hasIntensity());
  EXPECT_FALSE(scanFromObservation(*cloud(1, "lidar", 2), "lidar", {})->hasTimes());
  for (const float bad : {30.0f, -1.5f, kNan}) {  // milliseconds, a stamp elsewhere, no number
    o.time[2] = bad;
    EXPECT_THROW(scanFromObservation(o, "lidar", {}), std::runtime_error) << bad;
  }
}

TEST(ScanFromObservation, DropsBadPointsAndRanges) {
  auto o = cloud(1, "lidar", 0);
  auto& map = *o->pointcloud;
  map.insertPointFast(kNan, 1, 1);
  map.insertPointFast(1, kInf, 1);
  map.insertPointFast(0, 0, 0);
  map.insertPointFast(0.05f, 0, 0);
  map.insertPointFast(200, 0, 0);
  map.insertPointFast(5, 0, 0);
  o->sensorPose = mrpt::poses::CPose3D(100, 0, 0, 0, 0, 0);  // limits are the sensor's ranges
  const auto scan = scanFromObservation(*o, "lidar", {});
  ASSERT_EQ(scan->size(), 1u);
  expectPoint(scan->points[0], 105, 0, 0);
  EXPECT_EQ(scan->sensor.size(), 1u);

  ScanOptions no_minimum;
  no_minimum.min_range_m = 0;
  EXPECT_EQ(scanFromObservation(*o, "lidar", no_minimum)->size(), 2u) << "zero range stays out";
}

TEST(ScanFromObservation, EmptyScansHaveNoPoints) {
  EXPECT_EQ(scanFromObservation(*cloud(1, "l", 0), "l", {})->size(), 0u);
  EXPECT_EQ(scanFromObservation(mrpt::obs::CObservationPointCloud(), "l", {})->size(), 0u);
  EXPECT_EQ(scanFromObservation(mrpt::obs::CObservation2DRangeScan(), "l", {})->size(), 0u);
  EXPECT_EQ(scanFromObservation(mrpt::obs::CObservation3DRangeScan(), "l", {})->size(), 0u);
  EXPECT_EQ(scanFromObservation(mrpt::obs::CObservationVelodyneScan(), "l", {})->size(), 0u);
  EXPECT_EQ(scanFromObservation(mrpt::obs::CObservationRotatingScan(), "l", {})->size(), 0u);
}

TEST(ScanFromObservation, OtherClassesAreNoLidar) {
  EXPECT_FALSE(isLidar(*wheels(1, "odo")));
  EXPECT_FALSE(scanFromObservation(*wheels(1, "odo"), "odo", {}));
  EXPECT_TRUE(isLidar(*cloud(1, "lidar")));
}

TEST(ScanFromObservation, LaserRaysRunFromRightToLeft) {
  const auto scan = scanFromObservation(laser(3, 4.0f), "laser", {});
  ASSERT_EQ(scan->size(), 3u);
  expectPoint(scan->points[0], 0, -4, 0);
  expectPoint(scan->points[1], 4, 0, 0);
  expectPoint(scan->points[2], 0, 4, 0);
}

TEST(ScanFromObservation, LaserInvalidAndMaximumRangesAreDropped) {
  auto o = laser(5, 4.0f);
  o.setScanRangeValidity(0, false);
  o.setScanRange(1, o.maxRange);
  o.setScanRange(3, kNan);
  o.setScanHasIntensity(true);
  for (size_t i = 0; i < 5; ++i) o.setScanIntensity(i, static_cast<int>(10 * i));
  const auto scan = scanFromObservation(o, "laser", {});
  ASSERT_EQ(scan->size(), 2u);
  expectPoint(scan->points[0], 4, 0, 0);
  EXPECT_EQ(scan->intensity, (std::vector<float>{20, 40}));
}

TEST(ScanFromObservation, AWrongApertureCanBeCorrected) {
  auto o = laser(3, 2);
  ScanOptions options;
  options.laser_aperture_deg = 180;
  for (const float recorded : {0.0f, static_cast<float>(M_PI / 2)}) {
    o.aperture = recorded;
    const auto scan = scanFromObservation(o, "laser", options);
    ASSERT_EQ(scan->size(), 3u);
    expectPoint(scan->points[0], 0, -2, 0);
    expectPoint(scan->points[1], 2, 0, 0);
    expectPoint(scan->points[2], 0, 2, 0);
  }
}

TEST(ScanFromObservation, PlanarLaserIsLevel) {
  auto o = laser(3, 1);
  EXPECT_TRUE(isPlanarLaser(o));
  o.sensorPose = mrpt::poses::CPose3D(1, 2, 3, 2.0, 0.03, -0.03);
  EXPECT_TRUE(isPlanarLaser(o));
  o.sensorPose = mrpt::poses::CPose3D(0, 0, 0, 0, 0.04, 0);
  EXPECT_FALSE(isPlanarLaser(o));
  o.sensorPose = mrpt::poses::CPose3D(0, 0, 0, 1.0, 0, M_PI);  // upside down
  EXPECT_TRUE(isPlanarLaser(o));
  o.sensorPose = mrpt::poses::CPose3D(0, 0, 0, 1.0, 0, M_PI - 0.1);
  EXPECT_FALSE(isPlanarLaser(o));
  o.sensorPose = mrpt::poses::CPose3D(0, 0, 0, 0, M_PI / 2, 0);  // it scans the walls upwards
  EXPECT_FALSE(isPlanarLaser(o));
  EXPECT_FALSE(isPlanarLaser(*cloud(1, "lidar")));
}

TEST(ScanFromObservation, DepthImageIsProjected) {
  mrpt::obs::CObservation3DRangeScan o;
  o.hasRangeImage = true;
  o.range_is_depth = true;
  o.rangeUnits = 0.001f;
  o.rangeImage_setSize(9, 9);
  o.rangeImage.setZero();
  o.rangeImage(4, 4) = 2000;
  o.rangeImage(4, 0) = 2000;
  o.cameraParams.ncols = o.cameraParams.nrows = 9;
  o.cameraParams.setIntrinsicParamsFromValues(8, 8, 4, 4);
  o.sensorPose = mrpt::poses::CPose3D(0, 0, 1, 0, 0, 0);
  const auto scan = scanFromObservation(o, "camera", {});
  ASSERT_EQ(scan->size(), 2u);
  expectPoint(scan->points[0], 2, 1, 1);  // image left is the sensor's left
  expectPoint(scan->points[1], 2, 0, 1);
}

TEST(ScanFromObservation, RotatingLaserAgreesWithTheLaserItWasMadeFrom) {
  auto o = laser(181, 4.0f);
  for (size_t i = 0; i < o.getScanSize(); ++i) o.setScanRange(i, 2 + 0.01f * static_cast<float>(i));
  o.setScanRangeValidity(7, false);
  mrpt::obs::CObservationRotatingScan rotating;
  rotating.fromScan2D(o);
  const auto expected = scanFromObservation(o, "laser", {});
  const auto scan = scanFromObservation(rotating, "laser", {});
  ASSERT_EQ(scan->size(), 180u);
  ASSERT_EQ(expected->size(), 180u);
  for (size_t i = 0; i < scan->size(); ++i) {
    EXPECT_LT((scan->points[i] - expected->points[i]).norm(), 0.006) << i;  // 1 cm resolution
  }
}

TEST(ScanFromObservation, ASensorPoseThatIsNoNumberIsAnError) {
  // The last one is a number, but none that the float coordinates of points can hold.
  for (const double x : {std::nan(""), std::numeric_limits<double>::infinity(), 1e60}) {
    auto o = cloud(1, "lidar", 1);
    o->sensorPose = mrpt::poses::CPose3D(x, 0, 0, 0, 0, 0);
    EXPECT_THROW(scanFromObservation(*o, "lidar", {}), std::runtime_error) << x;
  }
}

TEST(ScanFromObservation, PointsThatNoFloatCanHoldAreDropped) {
  auto o = cloud(1, "lidar", 2);
  o->sensorPose = mrpt::poses::CPose3D(3.3e38, 0, 0, 0, 0, 0);
  auto points = mrpt::maps::CSimplePointsMap::Create();
  points->insertPoint(1e38f, 0, 0);
  points->insertPoint(1, 0, 0);
  o->pointcloud = points;
  ScanOptions options;
  options.max_range_m = 1e39;
  EXPECT_EQ(scanFromObservation(*o, "lidar", options)->size(), 1u);
}

TEST(ScanFromObservation, RotatingScanWithUnknownElevationsIsAnError) {
  mrpt::obs::CObservationRotatingScan o;
  o.rowCount = 2;
  o.columnCount = 4;
  o.rangeImage.setZero(2, 4);
  o.rangeResolution = 0.01;
  EXPECT_THROW(scanFromObservation(o, "lidar", {}), std::runtime_error);
}

}  // namespace
}  // namespace lamp
