#include "lamp/simulation/SurfaceNets.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "MeshTools.h"
#include "TestHollow.h"

namespace lamp::simulation {
namespace {

using namespace test;
using Eigen::Vector3d;

constexpr double kCell = 0.2;

/** Two crossing drives of rough rock that flow into one another, one of them sloped, and a pillar.
 * Many blocks wide. */
FreeSpace roughCrossing() {
  const WallStyle rock{0.3, 0.3, 0.3, 1.0, Material::kRock};
  FreeSpace space(11);
  space.add(hollow({-15, 0, 0}, {15, 1, 0}, 5, 3, rock));
  space.add(hollow({2, -14, -1}, {3, 16, 1}, 6, 4, rock));
  space.add(Pillar{{-6, 1, -2}, 0.8, 9, false});
  return space;
}

TEST(SurfaceNets, WallsLieWhereTheClosedFormSays) {
  const RoundedBox box;
  FreeSpace space(1);
  space.add(box.hollow());
  const Mesh mesh = wallMesh(space, kCell);
  ASSERT_GT(mesh.vertices.size(), 1000u);
  for (const Eigen::Vector3f& v : mesh.vertices)
    EXPECT_LT(std::abs(box.distance(v.cast<double>())), 0.15 * kCell);
  EXPECT_NEAR(area(mesh), box.area(), 0.02 * box.area());
  EXPECT_NEAR(volume(mesh), -box.volume(), 0.02 * box.volume()) << "negative: seen from inside";
}

TEST(SurfaceNets, NormalsPointIntoFreeSpace) {
  const RoundedBox box;
  FreeSpace space(1);
  space.add(box.hollow());
  const Mesh mesh = wallMesh(space, kCell);
  size_t degenerate = 0;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Vector3d middle =
        (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]).cast<double>() / 3.0;
    const Vector3d normal = mesh.normal(i).cast<double>();
    degenerate += normal.isZero();
    if (normal.isZero()) continue;
    EXPECT_LT(box.distance(middle + 0.2 * normal), box.distance(middle) - 0.1);
  }
  EXPECT_LT(100 * degenerate, mesh.triangles.size());
}

TEST(SurfaceNets, HasNoHolesNorSeams) {
  const RoundedBox box;
  FreeSpace smooth(1);
  smooth.add(box.hollow());
  for (const FreeSpace& space : {smooth, roughCrossing()}) {
    const Mesh mesh = wallMesh(space, kCell);
    EXPECT_EQ(openEdges(mesh), 0u);
    EXPECT_NEAR(volume(mesh), volume(mesh, {500, -300, 100}), 0.05);
  }
}

TEST(SurfaceNets, NoRayEscapes) {
  const Mesh mesh = wallMesh(roughCrossing(), kCell);
  const RayCaster caster(mesh);
  const auto directions = randomDirections(4000, 1);
  for (const Vector3d& eye :
       {Vector3d(2.5, 0.5, 1.3), Vector3d(-14, 0, 1), Vector3d(14, 1, 1.5), Vector3d(2, -13, 0.6),
        Vector3d(2.9, 15, 2.8), Vector3d(-7.2, 1.2, 1.4), Vector3d(-3.2, 0.1, 1.6)}) {
    const Panorama seen = lookAround(caster, eye, directions);
    EXPECT_EQ(seen.lost, 0u) << eye.transpose();
    EXPECT_EQ(seen.from_behind, 0u) << eye.transpose();
  }
}

TEST(SurfaceNets, MeshDoesNotDependOnTheNumberOfThreads) {
  const FreeSpace space = roughCrossing();
  Mesh one, two;
  tbb::task_arena(1).execute([&] { one = wallMesh(space, 0.3); });
  tbb::task_arena(2).execute([&] { two = wallMesh(space, 0.3); });
  EXPECT_TRUE(sameMesh(one, two));
}

TEST(SurfaceNets, SlopedDrivesHaveASlopedFloorAndRoof) {
  FreeSpace space(1);
  space.add(hollow({0, 0, 1}, {12, 0, 5}));
  const Mesh mesh = wallMesh(space, kCell);
  const RayCaster caster(mesh);
  for (double x = 1; x < 11; x += 0.31)
    for (const double y : {-0.9, 0.0, 0.7}) {
      const Eigen::Vector3f eye = Vector3d(x, y, 1 + x / 3 + 1.2).cast<float>();
      const auto floor = caster.cast(eye, {0, 0, -1}, 10), roof = caster.cast(eye, {0, 0, 1}, 10);
      ASSERT_TRUE(floor && roof);
      EXPECT_NEAR(floor->range_m, 1.2, 0.02);
      EXPECT_NEAR(roof->range_m, 1.8, 0.02);
    }
}

TEST(SurfaceNets, ASlopeMeetsALevelFloorWithoutASill) {
  FreeSpace space(1);
  Hollow level = hollow({-8, 0, 0}, {0, 0, 0}), ramp = hollow({0, 0, 0}, {10, 0, 3});
  level.corner_m = ramp.corner_m = level.level_m = ramp.level_m = 1;
  space.add(level);
  space.add(ramp);
  const Mesh mesh = wallMesh(space, kCell);
  const RayCaster caster(mesh);
  for (float x = -3; x < 3; x += 0.13f) {
    const float floor = 0.3f * std::max(0.0f, x);
    const auto hit = caster.cast({x, 0.1f, 1.5f + floor}, {0, 0, -1}, 10);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->range_m, 1.5f, 0.06f) << x;
  }
}

TEST(SurfaceNets, APillarStandsWhereItWasPut) {
  FreeSpace space(1);
  space.add(hollow({-10, 0, 0}, {10, 0, 0}, 16));
  space.add(Pillar{{2, 3, -1}, 0.7, 8, false});
  const Mesh mesh = wallMesh(space, kCell);
  const RayCaster caster(mesh);
  for (int i = 0; i < 12; ++i) {
    const double angle = M_PI * i / 6;
    const Eigen::Vector3f towards(static_cast<float>(-std::cos(angle)),
                                  static_cast<float>(-std::sin(angle)), 0);
    const Eigen::Vector3f eye = Eigen::Vector3f(2, 3, 1.4f) - 3 * towards;
    const auto hit = caster.cast(eye, towards, 10);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->range_m, 2.3, 0.03);
  }
}

TEST(SurfaceNets, EachWallHasTheMaterialOfItsHollow) {
  FreeSpace space(1);
  space.add(hollow({0, 0, 0}, {6, 0, 0}, 3, 3, {0, 0, 1, 0, Material::kRock}));
  space.add(hollow({20, 0, 0}, {26, 0, 0}, 3, 3, {0, 0, 1, 0, Material::kConcrete}));
  const Mesh mesh = wallMesh(space, kCell);
  ASSERT_EQ(mesh.materials.size(), mesh.triangles.size());
  for (size_t i = 0; i < mesh.triangles.size(); ++i)
    EXPECT_EQ(mesh.materials[i],
              mesh.vertices[mesh.triangles[i][0]].x() < 13 ? Material::kRock : Material::kConcrete);
}

TEST(SurfaceNets, ACoarseAndAFineMeshAgree) {
  const FreeSpace space = roughCrossing();
  const double fine = volume(wallMesh(space, 0.2)), coarse = volume(wallMesh(space, 0.4));
  EXPECT_NEAR(coarse / fine, 1, 0.02);
}

}  // namespace
}  // namespace lamp::simulation
