#include "lamp/scans/LonePoints.h"

#include <gmock/gmock.h>

#include <limits>

using namespace lamp;
using Eigen::Vector3f;
using testing::ElementsAre;

namespace {

Scan scanOf(std::vector<Vector3f> points) {
  Scan scan;
  scan.points = std::move(points);
  scan.sensors = {{"lidar", Eigen::Vector3d::Zero()}};
  for (size_t i = 0; i < scan.size(); ++i) {
    scan.sensor.push_back(0);
    scan.intensity.push_back(static_cast<float>(i));
    scan.time.push_back(0.1f * static_cast<float>(i));
  }
  return scan;
}

}  // namespace

TEST(LonePoints, AreLeftOutWithTheirFields) {
  const Scan rest =
      withoutLonePoints(scanOf({{0, 0, 0}, {50, 0, 0}, {0.9f, 0, 0}, {0, -80, 3}, {50, 30, 0}}), 1);
  EXPECT_THAT(rest.points, ElementsAre(Vector3f(0, 0, 0), Vector3f(0.9f, 0, 0)));
  EXPECT_THAT(rest.intensity, ElementsAre(0, 2));
  EXPECT_THAT(rest.time, ElementsAre(0, 0.2f));
  EXPECT_EQ(rest.sensor.size(), 2u);
  EXPECT_EQ(rest.sensors.size(), 1u);
}

TEST(LonePoints, ANeighborAcrossAnyBorderOfACellCounts) {
  for (const Vector3f& step : {Vector3f(0.2f, 0, 0), Vector3f(0, 0.2f, 0), Vector3f(0, 0, 0.2f),
                               Vector3f(0.1f, 0.1f, -0.1f)}) {
    const Vector3f border(7, -3, 2);
    EXPECT_EQ(withoutLonePoints(scanOf({border - 0.5f * step, border + 0.5f * step}), 1).size(), 2u)
        << step.transpose();
  }
}

TEST(LonePoints, PointsThatAreNowhereAreNoNeighbors) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(withoutLonePoints(scanOf({{0, 0, 0}, {0, 0, nan}}), 1).size(), 0u);
}
