#include "lamp/scans/PreparedScan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "TestRooms.h"

namespace lamp {
namespace {

using Eigen::Vector3f;

TEST(PreparedScan, NormalsOfARoomPointAlongItsAxes) {
  const auto scan = prepareScan(roomPoints(6000, 0.0f, 1), 10, false);
  size_t aligned = 0;
  for (const auto& normal : scan->normals())
    aligned += normal.cwiseAbs().maxCoeff() > 0.99f ? 1 : 0;
  EXPECT_GT(aligned, scan->size() * 8 / 10);
}

TEST(PreparedScan, NormalsLookAtTheLidar) {
  const auto scan = prepareScan(roomPoints(3000, 0.01f, 1), 10, false);
  for (size_t i = 0; i < scan->size(); ++i)
    EXPECT_LE(scan->normals()[i].dot(scan->points()[i]), 0.0f);
}

TEST(PreparedScan, PlanarNormalsLieInThePlaneAndThereAreNoFeatures) {
  const auto scan = prepareScan(planarRoomPoints(600, 0.005f, 1), 6, true);
  for (const auto& normal : scan->normals()) EXPECT_EQ(normal.z(), 0.0f);
  EXPECT_EQ(scan->features().size(), 0u);
}

TEST(PreparedScan, NoiseIsThatOfThePoints) {
  for (const float noise : {0.01f, 0.03f, 0.1f}) {
    EXPECT_NEAR(prepareScan(roomPoints(6000, noise, 1), 10, false)->noise(), noise, 0.3 * noise);
    EXPECT_NEAR(prepareScan(planarRoomPoints(700, noise, 1), 10, true)->noise(), noise,
                0.3 * noise);
  }
  EXPECT_EQ(prepareScan({}, 10, false)->noise(), 0);
}

TEST(PreparedScan, NormalsOfANoisyLaserAreThoseOfTheWalls) {
  // Ten neighbours of 0.05 m spacing and 0.2 m noise are a ball.
  const auto scan = prepareScan(planarRoomPoints(600, 0.2f, 1), 10, true);
  size_t aligned = 0;
  for (const auto& normal : scan->normals()) aligned += normal.cwiseAbs().maxCoeff() > 0.9f ? 1 : 0;
  EXPECT_GT(aligned, scan->size() * 7 / 10);
}

TEST(PreparedScan, CoarsenessIsThatOfSparsePoints) {
  EXPECT_EQ(prepareScan(roomPoints(6000, 0.01f, 1), 10, false)->coarseness(), 1.0);
  std::vector<Vector3f> grid;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) grid.emplace_back(1.2f * i, 1.2f * j, 0.0f);
  EXPECT_NEAR(prepareScan(grid, 10, false)->coarseness(), 3.0, 1e-5);
  EXPECT_EQ(prepareScan({{1, 2, 3}}, 10, false)->coarseness(), 1.0);
}

TEST(PreparedScan, LeavesOutWhatIsNoPlace) {
  const auto scan = prepareScan(
      {{1, 2, 3}, {NAN, 0, 0}, {0, -INFINITY, 0}, {3e38f, 3e38f, 0}, {2e6f, 0, 0}, {9e5f, 0, 0}},
      10, false);
  EXPECT_EQ(scan->size(), 2u);
  EXPECT_EQ(scan->own().size(), 2u);
  EXPECT_EQ(scan->normals().size(), 2u);
}

TEST(PreparedScan, OwnAreThePointsOfTheFirstScan) {
  Cloud cloud = cloudSeenFromOrigin(roomPoints(100, 0.0f, 1));
  cloud.viewpoints.push_back({1, 1, 1});
  for (size_t i = 0; i < cloud.size(); ++i) cloud.viewpoint[i] = i % 4 == 0 ? 0 : 1;
  const PreparedScan scan(cloud, {}, false);
  std::vector<Vector3f> own, expected;
  for (const uint32_t i : scan.own()) own.push_back(scan.points()[i]);
  for (size_t i = 0; i < cloud.size(); i += 4) expected.push_back(cloud.points[i]);
  const auto less = [](const Vector3f& a, const Vector3f& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::sort(own.begin(), own.end(), less);
  std::sort(expected.begin(), expected.end(), less);
  EXPECT_EQ(own, expected);
}

TEST(PreparedScan, FewAndEqualPoints) {
  for (const size_t count : {0u, 1u, 3u, 100u}) {
    const auto scan = prepareScan(std::vector<Vector3f>(count, Vector3f(1, 1, 1)), 10, false);
    EXPECT_EQ(scan->size(), count);
    for (const auto& normal : scan->normals()) EXPECT_TRUE(normal.isZero());
    EXPECT_EQ(scan->features().size(), 0u);
  }
}

TEST(PreparedScan, HoldsAMillionPoints) {
  const auto scan = prepareScan(roomPoints(1000000, 0.01f, 1), 5, false);
  EXPECT_EQ(scan->size(), 1000000u);
  EXPECT_GT(scan->features().size(), 100u);
  EXPECT_GT(scan->bytes(), 1000000 * 2 * sizeof(Vector3f));
}

TEST(PreparedScan, ManyThreadsGetTheSameFeatures) {
  const auto scan = prepareScan(roomPoints(3000, 0.01f, 1), 10, false);
  const auto alone = prepareScan(roomPoints(3000, 0.01f, 1), 10, false);
  std::vector<const Features*> seen(8);
  std::vector<std::thread> threads;
  for (auto& place : seen) threads.emplace_back([&] { place = &scan->features(); });
  for (auto& thread : threads) thread.join();
  for (const Features* features : seen) {
    ASSERT_EQ(features, seen.front());
    EXPECT_EQ(features->descriptors, alone->features().descriptors);
  }
}

}  // namespace
}  // namespace lamp
