#include "ScanMerger.h"

#include <gtest/gtest.h>

#include "TestObservations.h"

namespace lamp {
namespace {

using namespace test;

/** A robot that drives at 2 m/s along x. */
Pose3 driving(double from, double to) {
  return planarPose(2 * (to - from), 0, 0);
}

/** One row of a lidar that turns within a second, each range 10 m. */
InputObservation turning(double stamp) {
  auto scan = mrpt::obs::CObservationRotatingScan::Create();
  scan->rowCount = 1;
  scan->columnCount = 8;
  scan->rangeResolution = 0.01;
  scan->sweepDuration = 0.8;
  scan->startAzimuth = -M_PI;
  scan->azimuthSpan = 2 * M_PI;
  scan->rangeImage.resize(1, 8);
  for (int i = 0; i < 8; ++i) scan->rangeImage(0, i) = 1000;
  return wrapped(stamp, "turning", scan);
}

TEST(ScanMerger, PutsPointsWhereTheyWereWhenTheyWereSeen) {
  ScanMerger merger{ScanOptions()};
  const Scan still =
      merger.merge({kStart, {turning(kStart)}}, [](double, double) { return Pose3::Identity(); });
  const Scan moved = merger.merge({kStart, {turning(kStart)}}, driving);
  ASSERT_EQ(still.size(), 8u);
  ASSERT_TRUE(still.hasTimes());
  EXPECT_GT(merger.sweep(), 0.6);
  for (size_t i = 0; i < still.size(); ++i) {
    const Eigen::Vector3f expected = still.points[i] + Eigen::Vector3f(2 * still.time[i], 0, 0);
    EXPECT_TRUE(moved.points[i].isApprox(expected, 1e-4f)) << i;
  }
}

TEST(ScanMerger, JoinsThePiecesOfASweep) {
  ScanMerger merger{ScanOptions()};
  const Scan scan =
      merger.merge({kStart,
                    {cloud(kStart, {{1, 0, 0}}, "front"), cloud(kStart + 0.5, {{0, 1, 0}}, "front"),
                     cloud(kStart - 0.5, {{0, 0, 1}}, "rear")}},
                   driving);
  ASSERT_EQ(scan.size(), 3u);
  EXPECT_EQ(scan.sensors.size(), 2u);
  EXPECT_EQ(scan.sensor, (std::vector<uint8_t>{0, 0, 1}));
  EXPECT_TRUE(scan.sensors[0].position.isZero(1e-9)) << "where the lidar was at the scan's stamp";
  EXPECT_TRUE(scan.points[1].isApprox(Eigen::Vector3f(1, 1, 0), 1e-5f));
  EXPECT_TRUE(scan.points[2].isApprox(Eigen::Vector3f(-1, 0, 1), 1e-5f));
  EXPECT_FALSE(scan.hasTimes());
  EXPECT_NEAR(merger.sweep(), 0.5, 1e-6) << "what another lidar has seen before does not count";
}

}  // namespace
}  // namespace lamp
