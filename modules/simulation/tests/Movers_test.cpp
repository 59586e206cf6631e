#include "lamp/simulation/Movers.h"

#include <gtest/gtest.h>

#include "SmallMission.h"
#include "TestLayout.h"
#include "TestMesh.h"
#include "TestMotion.h"
#include "lamp/simulation/TruthFiles.h"

namespace lamp::simulation {
namespace {

using namespace test;
using Eigen::Vector3f;

Mover boxAt(const Eigen::Vector3d& foot, const Vector3f& size) {
  return {size, Material::kConcrete, standing(10, Pose3(Eigen::Translation3d(foot)))};
}

TEST(Mover, IsHitWhereItsBoxIs) {
  const Mover mover = boxAt({0, 0, 0}, {2, 1, 1.5f});
  const auto hit = mover.cast({-5, 0.2f, 1}, {1, 0, 0});
  ASSERT_TRUE(hit);
  EXPECT_FLOAT_EQ(hit->range_m, 4);
  EXPECT_EQ(hit->normal, Vector3f(-1, 0, 0));
  const auto from_above = mover.cast({0.5f, 0, 4}, {0, 0, -1});
  ASSERT_TRUE(from_above);
  EXPECT_FLOAT_EQ(from_above->range_m, 2.5f);
  EXPECT_EQ(from_above->normal, Vector3f(0, 0, 1));

  EXPECT_FALSE(mover.cast({-5, 0.6f, 1}, {1, 0, 0})) << "beside";
  EXPECT_FALSE(mover.cast({-5, 0, 1.6f}, {1, 0, 0})) << "above";
  EXPECT_FALSE(mover.cast({5, 0, 1}, {1, 0, 0})) << "behind";
  EXPECT_FALSE(mover.cast({0, 0, 1}, {1, 0, 0})) << "within";
}

struct Ring {
  Layout layout = ringLayout();
  Mesh floor;
  Ring() { addQuad(floor, {-9, -9, 0.25f}, {99, -9, 0.25f}, {99, 99, 0.25f}, {-9, 99, 0.25f}); }
};

TEST(Movers, WalkOnTheFloorOfThePassagesAtTheirSpeed) {
  const Ring ring;
  const RayCaster caster(ring.floor);
  MoverOptions options;
  options.people = 3;
  options.vehicles = 1;
  options.stop_share = 0;
  const auto movers = makeMovers(options, ring.layout, caster, {kBegin, kBegin + 100}, 5);
  ASSERT_EQ(movers.size(), 4u);
  for (const Mover& mover : movers) {
    EXPECT_LE(mover.world_T_mover.begin(), kBegin);
    EXPECT_GE(mover.world_T_mover.end(), kBegin + 100);
    double length = 0;
    Eigen::Vector3d before = mover.world_T_mover.at(kBegin).translation();
    for (double t = 0; t < 100; t += 0.1) {
      const Eigen::Vector3d here = mover.world_T_mover.at(kBegin + t).translation();
      EXPECT_NEAR(here.z(), 0.25, 1e-6);
      EXPECT_LT(ring.layout.distanceToPassages(here), 3.5) << "half the widest passage";
      length += (here - before).norm();
      before = here;
    }
    const bool person = mover.size.x() < 1;
    EXPECT_NEAR(length / 100, person ? options.person_speed_mps : options.vehicle_speed_mps, 0.2);
  }
}

TEST(Movers, StopAtPlaces) {
  const Ring ring;
  const RayCaster caster(ring.floor);
  MoverOptions options;
  options.people = 1;
  options.stop_share = 1;
  options.stop_s = 20;
  const auto movers = makeMovers(options, ring.layout, caster, {kBegin, kBegin + 300}, 5);
  size_t stands = 0;
  for (int t = 0; t < 300; ++t) {
    const auto at = [&](double s) { return movers[0].world_T_mover.at(kBegin + s).translation(); };
    stands += (at(t + 0.5) - at(t)).norm() < 1e-6;
  }
  EXPECT_GT(stands, 60u);
  EXPECT_LT(stands, 270u);
}

/** A person two metres ahead, who walks to the left at 1 m/s before a wall. */
TEST(Movers, ALidarSeesThemWhereTheyAreThen) {
  const Mesh mesh = wallAt(5, 50);
  const RayCaster caster(mesh);
  Vector6d left = Vector6d::Zero();
  left[1] = 1;
  const TrajectoryInterpolator walk =
      motion(20, [&](double t) { return Pose3(Eigen::Translation3d(2.25, t - 10, -1)); });
  const auto movers = std::make_shared<const std::vector<Mover>>(
      std::vector<Mover>{{Vector3f(0.5f, 0.5f, 2), Material::kConcrete, walk}});
  LidarOptions options;
  options.pose = {0, 0, 0, 0, 0, 0};
  options.range_sigma_m = options.dropout = options.dust_per_m = 0;
  const Lidar lidar(options, caster, movers), alone(options, caster);
  const TrajectoryInterpolator robot = standing(20);
  for (const double seconds : {9.5, 10.0, 10.5}) {
    const LidarSweep sweep = lidar.sweep(robot, kBegin + seconds, 1);
    size_t moving = 0;
    for (const LidarReturn& r : sweep.returns) {
      EXPECT_FALSE(r.fromDust());
      if (!r.moves) continue;
      ++moving;
      EXPECT_EQ(r.triangle, LidarReturn::kNoTriangle);
      const double middle = r.stamp - kBegin - 10;
      EXPECT_LE(std::abs(r.point.y() - middle), 0.25 + 1e-3);
      EXPECT_GE(r.point.x(), 2 - 1e-3);
      EXPECT_LE(r.point.x(), 2.5 + 1e-3);
    }
    EXPECT_GT(moving, 100u);
    std::vector<Vector3f> points;
    appendMoving(sweep, lidar, robot, kBegin + seconds, points);
    EXPECT_EQ(points.size(), moving);
  }
  for (const LidarReturn& r : alone.sweep(robot, kBegin + 10, 1).returns) EXPECT_FALSE(r.moves);
}

TEST(Movers, ThoseFarAwayChangeNothing) {
  const Mesh mesh = wallAt(5, 50);
  const RayCaster caster(mesh);
  const auto far = std::make_shared<const std::vector<Mover>>(
      std::vector<Mover>{boxAt({10, 0, -1}, {1, 1, 2})});  // behind the wall
  const LidarSweep with = Lidar({}, caster, far).sweep(standing(1), kBegin, 1),
                   without = Lidar({}, caster).sweep(standing(1), kBegin, 1);
  ASSERT_EQ(with.returns.size(), without.returns.size());
  for (size_t i = 0; i < with.returns.size(); ++i) {
    EXPECT_EQ(with.returns[i].point, without.returns[i].point);
    EXPECT_EQ(with.returns[i].intensity, without.returns[i].intensity);
  }
}

TEST(Movers, AMissionHasThemAndTheyLeaveTheRobotsAlone) {
  const SmallMission& without = SmallMission::shared();
  SimConfig config = without.config;
  config.movers.people = 12;
  const Mission mission = makeMission(config, without.world, without.caster, 10);
  ASSERT_TRUE(mission.movers);
  EXPECT_EQ(mission.movers->size(), 12u);
  EXPECT_FALSE(without.mission.movers);
  SeenTriangles seen(without.world.mesh.triangles.size());
  size_t moving = 0;
  for (size_t r = 0; r < mission.robots.size(); ++r) {
    const MissionRobot& robot = mission.robots[r];
    EXPECT_EQ(robot.key_nodes, without.mission.robots[r].key_nodes);
    EXPECT_EQ(robot.truth.at(robot.truth.end()).matrix(),
              without.mission.robots[r].truth.at(robot.truth.end()).matrix());
    for (size_t i = 0; i < robot.key_nodes.size(); ++i)
      moving += keyedScan(robot, i, config.keyed, seen).moving.size();
  }
  EXPECT_GT(moving, 1000u);
}

TEST(Movers, TheirReturnsAreAFileOfTheTruth) {
  const std::string text = moversPly({{3, {{1, 2, 3}, {4, 5, 6}}}, {70, {{7, 8, 9}}}});
  const std::string end = "end_header\n";
  EXPECT_NE(text.find("element vertex 3\nproperty float scan\nproperty float x\n"),
            std::string::npos);
  std::array<float, 12> values;
  ASSERT_EQ(text.size() - text.find(end) - end.size(), sizeof values);
  std::memcpy(values.data(), &text[text.find(end) + end.size()], sizeof values);
  EXPECT_EQ(values, (std::array<float, 12>{3, 1, 2, 3, 3, 4, 5, 6, 70, 7, 8, 9}));
}

}  // namespace
}  // namespace lamp::simulation
