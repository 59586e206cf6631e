#include "lamp/simulation/RayCaster.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lamp::simulation {
namespace {

/** A wall of 2 x 2 m at x = `distance`, facing the origin. */
Mesh wall(float distance) {
  Mesh mesh;
  mesh.vertices = {{distance, -1, -1}, {distance, 1, -1}, {distance, 1, 1}, {distance, -1, 1}};
  mesh.triangles = {{0, 3, 1}, {1, 3, 2}};
  mesh.materials = {Material::kRock, Material::kMetal};
  return mesh;
}

TEST(RayCaster, MeasuresTheDistanceAlongTheRay) {
  const Mesh mesh = wall(5);
  const RayCaster caster(mesh);
  const Eigen::Vector3f direction = Eigen::Vector3f(1, 0.1f, -0.05f).normalized();
  const auto hit = caster.cast({0, 0, 0}, direction, 100);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range_m * direction.x(), 5.0, 1e-4);
  EXPECT_NEAR(mesh.normal(hit->triangle).x(), -1.0, 1e-6) << "towards free space";
}

TEST(RayCaster, MissesWhatIsBesideAndBeyond) {
  const Mesh mesh = wall(5);
  const RayCaster caster(mesh);
  EXPECT_FALSE(caster.cast({0, 0, 0}, {0, 1, 0}, 100));
  EXPECT_FALSE(caster.cast({0, 0, 0}, {1, 0, 0}, 4.9f));
}

TEST(RayCaster, SeesTheNearerOfTwoWalls) {
  Mesh mesh = wall(5);
  mesh.append(wall(3));
  const RayCaster caster(mesh);
  const auto hit = caster.cast({0, 0.1f, 0}, {1, 0, 0}, 100);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range_m, 3.0, 1e-4);
  EXPECT_GE(hit->triangle, 2u);
}

TEST(RayCaster, AWallHidesWhatIsBehindIt) {
  const Mesh mesh = wall(5);
  const RayCaster caster(mesh);
  EXPECT_FALSE(caster.visible({0, 0, 0}, {6, 0, 0}));
  EXPECT_TRUE(caster.visible({0, 0, 0}, {4, 0, 0}));
  EXPECT_TRUE(caster.visible({0, 0, 0}, {5, 0, 0})) << "the wall itself can be seen";
  EXPECT_TRUE(caster.visible({0, 3, 0}, {6, 3, 0}));
}

}  // namespace
}  // namespace lamp::simulation
