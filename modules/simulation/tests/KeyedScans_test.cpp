#include "lamp/simulation/KeyedScans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "MeshTools.h"
#include "SmallMission.h"
#include "TestMesh.h"
#include "TestMotion.h"

namespace lamp::simulation {
namespace {

using namespace test;

/** Random points in a cube of 10 m, of two sensors in turn. */
Scan cubeScan(size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-5, 5);
  Scan scan;
  scan.sensors.resize(2);
  for (size_t i = 0; i < count; ++i) {
    scan.points.emplace_back(uniform(random), uniform(random), uniform(random));
    scan.intensity.push_back(static_cast<float>(i));
    scan.sensor.push_back(static_cast<uint8_t>(i % 2));
  }
  return scan;
}

TEST(Thinned, KeepsPointsThatAreFarApart) {
  const Scan scan = cubeScan(200);
  const Scan result = thinned(scan, 5000);
  EXPECT_EQ(result.points, scan.points);
  EXPECT_EQ(result.intensity, scan.intensity);
  EXPECT_EQ(result.sensor, scan.sensor);
  EXPECT_EQ(result.sensors.size(), 2u);
}

TEST(Thinned, LeavesAsManyPointsAsAskedAndNotManyLess) {
  const Scan scan = cubeScan(20000);
  for (const size_t most : {50u, 700u, 5000u}) {
    const Scan result = thinned(scan, most);
    EXPECT_LE(result.size(), most);
    EXPECT_GE(result.size(), most / 3);
    EXPECT_EQ(result.intensity.size(), result.size());
    EXPECT_EQ(result.sensor.size(), result.size());
    for (size_t i = 0; i < result.size(); ++i) {
      const auto from = static_cast<size_t>(result.intensity[i]);
      EXPECT_EQ(result.points[i], scan.points[from]) << "points keep what belongs to them";
      EXPECT_EQ(result.sensor[i], scan.sensor[from]);
    }
  }
}

TEST(Thinned, KeepsTheFirstOfEachVoxelWhicheverSensorSawIt) {
  Scan scan;
  scan.sensors.resize(2);
  scan.points = {
      {0.01f, 0.01f, 0.01f}, {0.02f, 0.05f, 0.09f}, {0.03f, 0.03f, 0.03f}, {-0.01f, 0.01f, 0.01f}};
  scan.intensity = {0, 1, 2, 3};
  scan.sensor = {0, 0, 1, 0};
  EXPECT_EQ(thinned(scan, 100).intensity, (std::vector<float>{0, 3}));
}

TEST(Thinned, OfNoPoints) {
  EXPECT_EQ(thinned(Scan(), 100).size(), 0u);
}

/** An upper bound of the distance from a surface: the shortest of some rays. */
float distanceFromSurface(const RayCaster& caster, const Eigen::Vector3f& p) {
  static const auto directions = randomDirections(40, 8);
  float nearest = 1e9f;
  for (const Eigen::Vector3f& direction : directions)
    if (const auto hit = caster.cast(p, direction, 1)) nearest = std::min(nearest, hit->range_m);
  return nearest;
}

TEST(KeyedScan, PointsLieOnTheTrueSurfaceWhenPlacedWithTheTruth) {
  const SmallMission& small = SmallMission::shared();
  for (size_t r = 0; r < small.scans.size(); ++r) {
    size_t points = 0, near = 0;
    for (size_t i = 0; i < small.scans[r].size(); i += 3) {
      const MissionRobot& robot = small.mission.robots[r];
      const Pose3 world_T_base = robot.truth.at(robot.stampOf(i));
      for (const Eigen::Vector3f& p : small.scans[r][i]->points) {
        const Eigen::Vector3f in_world = (world_T_base * p.cast<double>()).cast<float>();
        near += distanceFromSurface(small.caster, in_world) < 0.1f;
        ++points;
      }
    }
    ASSERT_GT(points, 5000u);
    EXPECT_GT(static_cast<double>(near), 0.93 * static_cast<double>(points))
        << small.mission.robots[r].name << ": the rest is dust, and errors of odometry";
  }
}

TEST(KeyedScan, HoldsAtMostMaxPointsAndSeesAllAround) {
  for (const auto& scans : SmallMission::shared().scans)
    for (const KeyedScanPtr& scan : scans) {
      EXPECT_LE(scan->size(), 1500u);
      EXPECT_GE(scan->size(), 700u);
      EXPECT_EQ(scan->intensity.size(), scan->size());
      std::array<int, 4> quadrants{};
      for (const Eigen::Vector3f& p : scan->points)
        ++quadrants[static_cast<size_t>(2 * (p.x() > 0) + (p.y() > 0))];
      for (const int count : quadrants) EXPECT_GT(count, 20);
    }
}

TEST(KeyedScan, NamesItsSensorsAndWhereTheyWere) {
  const SmallMission& small = SmallMission::shared();
  const auto& alpha = small.scans[0][5]->sensors;
  ASSERT_EQ(alpha.size(), 1u);
  EXPECT_EQ(alpha[0].label, "top");
  // In the middle of the sweep: the robot drives on by at most 6 cm.
  EXPECT_LT((alpha[0].position - Eigen::Vector3d(0.1, 0, 0.8)).norm(), 0.08);
  const Scan& bravo = *small.scans[1][5];
  ASSERT_EQ(bravo.sensors.size(), 2u);
  EXPECT_EQ(bravo.sensors[1].label, "hovermap");
  for (const uint8_t sensor : {0, 1})
    EXPECT_GT(std::count(bravo.sensor.begin(), bravo.sensor.end(), sensor), 100);
}

TEST(KeyedScan, IsTheSameEachTime) {
  const SmallMission& small = SmallMission::shared();
  SeenTriangles seen(small.world.mesh.triangles.size());
  const Scan again = keyedScan(small.mission.robots[1], 7, small.config.keyed, seen).scan;
  EXPECT_EQ(again.points, small.scans[1][7]->points);
  EXPECT_EQ(again.intensity, small.scans[1][7]->intensity);
}

TEST(KeyedScan, MarksWhatWasSeen) {
  LidarSweep sweep;
  sweep.returns.resize(3);
  sweep.returns[0].triangle = 2;
  sweep.returns[1].triangle = LidarReturn::kNoTriangle;
  sweep.returns[2].triangle = 4;
  SeenTriangles seen(6);
  markSeen(sweep, seen);
  for (size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], i == 2 || i == 4) << i;

  const SmallMission& small = SmallMission::shared();
  const auto count = std::count(small.seen.begin(), small.seen.end(), true);
  EXPECT_GT(count, 5000);
  EXPECT_LT(count, static_cast<ptrdiff_t>(small.seen.size())) << "the far side of things is not";
}

TEST(KeyedScan, LidarsHaveSeedsOfTheirOwn) {
  std::set<uint64_t> seeds;
  for (const MissionRobot& robot : SmallMission::shared().mission.robots)
    for (size_t lidar = 0; lidar < 3; ++lidar) seeds.insert(lidarSeed(robot, lidar));
  EXPECT_EQ(seeds.size(), 6u);
}

}  // namespace
}  // namespace lamp::simulation
