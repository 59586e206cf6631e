#include "lamp/scans/SurfaceSupport.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <thread>
#include <vector>

#include "TestCorridors.h"
#include "TestRooms.h"
#include "lamp/scans/PreparedScan.h"

namespace lamp {
namespace {

using Eigen::Vector3f;

double shareSupported(const PreparedScan& scan) {
  double sum = 0;
  for (size_t i = 0; i < scan.size(); ++i) sum += scan.isOnSurface(i);
  return sum / static_cast<double>(scan.size());
}

/** Mean square of the normals' part along x, of all or of those with support. */
double alongX(const PreparedScan& scan, bool supported_only) {
  double sum = 0, count = 0;
  for (size_t i = 0; i < scan.size(); ++i) {
    if (supported_only && !scan.isOnSurface(i)) continue;
    sum += scan.normals()[i].x() * scan.normals()[i].x();
    ++count;
  }
  return sum / count;
}

TEST(SurfaceSupport, WallsHaveItWhateverTheirDirection) {
  EXPECT_GT(shareSupported(*prepareScan(roomPoints(3000, 0.01f, 1), 10, false)), 0.7);
  EXPECT_GT(shareSupported(*prepareScan(planarRoomPoints(700, 0.01f, 1), 6, true)), 0.7);
}

TEST(SurfaceSupport, IsTheSameHoweverTheLidarIsMounted) {
  const auto points = roomPoints(3000, 0.01f, 1);
  const double upright = shareSupported(*prepareScan(points, 10, false));
  for (const double pitch_deg : {45.0, 90.0, 180.0}) {
    const Eigen::AngleAxisf turn(static_cast<float>(pitch_deg * M_PI / 180), Vector3f::UnitY());
    std::vector<Vector3f> tilted;
    for (const Vector3f& point : points) tilted.push_back(turn * point);
    EXPECT_NEAR(shareSupported(*prepareScan(tilted, 10, false)), upright, 0.01) << pitch_deg;
  }
}

TEST(SurfaceSupport, ANoisyLaserLosesNone) {
  const double clean = shareSupported(*prepareScan(planarRoomPoints(360, 0.002f, 1), 10, true));
  const double noisy = shareSupported(*prepareScan(planarRoomPoints(360, 0.03f, 1), 10, true));
  EXPECT_GT(noisy, clean - 0.15);
}

TEST(SurfaceSupport, TheOutlineOfACorridorThatFarRingsDrawHasNone) {
  const auto scan = prepareScan(scanOf({}, {128, 1024, 100, 0.01}, 0, 1), 10, false);
  EXPECT_GT(alongX(*scan, false), 0.05) << "normals of far rings look along the corridor";
  EXPECT_LT(alongX(*scan, true), 0.01);
  EXPECT_GT(shareSupported(*scan), 0.7) << "the walls keep theirs";
}

TEST(SurfaceSupport, AWallAtTheEndHasIt) {
  SmoothCorridor closed;
  closed.end_m = 15;
  const auto scan = prepareScan(scanOf(closed, {32, 1024, 100, 0.01}, 0, 1), 10, false);
  double wall = 0, supported = 0;
  for (size_t i = 0; i < scan->size(); ++i) {
    const Vector3f& p = scan->points()[i];
    if (p.x() < 14.9f || std::abs(p.y()) > 1.5f || p.z() > 1.5f || p.z() < -0.5f) continue;
    ++wall;
    supported += scan->isOnSurface(i);
  }
  ASSERT_GT(wall, 20);
  EXPECT_GT(supported, 0.9 * wall);
}

TEST(SurfaceSupport, ASingleRingHasNone) {
  const SmoothCorridor pipe{true};
  const double up = 5 * M_PI / 180;
  std::vector<Vector3f> ring;
  for (int k = 0; k < 400; ++k) {
    const double around = k * M_PI / 200;
    const Eigen::Vector3d ray(std::cos(around) * std::cos(up), std::sin(around) * std::cos(up),
                              std::sin(up));
    ring.push_back((pipe.range(0, ray) * ray).cast<float>());
  }
  EXPECT_EQ(shareSupported(*prepareScan(ring, 10, false)), 0.0);
}

TEST(SurfaceSupport, OfNothingIsNothing) {
  EXPECT_FALSE(prepareScan({{1, 2, 3}}, 10, false)->isOnSurface(0));
  const auto in_the_lidar = prepareScan({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, 10, false);
  for (size_t i = 0; i < 3; ++i) EXPECT_FALSE(in_the_lidar->isOnSurface(i));
}

TEST(SurfaceSupport, IsTheSameInWhateverOrderManyThreadsAskForIt) {
  const auto points = roomPoints(3000, 0.01f, 1);
  const auto one = prepareScan(points, 10, false), many = prepareScan(points, 10, false);
  std::vector<std::thread> threads;
  for (size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (size_t k = 0; k < many->size(); ++k) many->isOnSurface((7 * k + 500 * t) % many->size());
    });
  for (std::thread& thread : threads) thread.join();
  size_t different = 0;
  for (size_t i = 0; i < one->size(); ++i) different += one->isOnSurface(i) != many->isOnSurface(i);
  EXPECT_EQ(different, 0u);
}

}  // namespace
}  // namespace lamp
