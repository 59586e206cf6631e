#include "lamp/simulation/Solids.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "MeshTools.h"
#include "lamp/core/Geometry.h"

namespace lamp::simulation {
namespace {

using namespace test;
using Eigen::Vector3d;

Pose3 pose(double x, double y, double z, double yaw, double pitch = 0, double roll = 0) {
  return poseFromYawPitchRoll((Vector6d() << x, y, z, yaw, pitch, roll).finished());
}

void expectClosed(const Mesh& mesh) {
  EXPECT_NEAR(volume(mesh), volume(mesh, {40, -30, 20}), 1e-3);
}

/** Rays from a sphere around a solid towards its middle hit it from outside. */
void expectFacesOutwards(const Mesh& mesh, const Vector3d& middle) {
  const RayCaster caster(mesh);
  for (const Eigen::Vector3f& out : randomDirections(2000, 3)) {
    const auto hit = caster.cast(middle.cast<float>() + 20 * out, -out, 20);
    ASSERT_TRUE(hit) << "seen from " << out.transpose();
    EXPECT_GT(mesh.normal(hit->triangle).dot(out), 0) << "seen from " << out.transpose();
  }
}

/** The longest of the two sides at the right angle of all triangles. */
float widestTriangle(const Mesh& mesh) {
  float widest = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    std::array<float, 3> sides = {(mesh.vertices[a] - mesh.vertices[b]).norm(),
                                  (mesh.vertices[b] - mesh.vertices[c]).norm(),
                                  (mesh.vertices[c] - mesh.vertices[a]).norm()};
    std::sort(sides.begin(), sides.end());
    widest = std::max(widest, sides[1]);
  }
  return widest;
}

TEST(Solids, ABoxIsClosedAndFacesOutwards) {
  const Pose3 world_T_box = pose(2, -1, 0.5, 0.7, 0.2, -0.1);
  const Vector3d size(1.3, 0.7, 2.1);
  const Mesh mesh = box(world_T_box, size, Material::kMetal);
  expectClosed(mesh);
  EXPECT_NEAR(volume(mesh), size.prod(), 1e-4);
  EXPECT_NEAR(area(mesh), 2 * (1.3 * 0.7 + 0.7 * 2.1 + 2.1 * 1.3), 1e-4);
  expectFacesOutwards(mesh, world_T_box * Vector3d(0, 0, 0.5 * size.z()));
  EXPECT_LE(widestTriangle(mesh), 0.3001f);
  EXPECT_TRUE(std::all_of(mesh.materials.begin(), mesh.materials.end(),
                          [](Material m) { return m == Material::kMetal; }));
}

TEST(Solids, ABoxStandsOnItsPose) {
  const Mesh mesh = box(pose(1, 2, 3, 0), {1, 2, 4}, Material::kConcrete);
  Eigen::AlignedBox3f bounds;
  for (const Eigen::Vector3f& v : mesh.vertices) bounds.extend(v);
  EXPECT_TRUE(bounds.min().isApprox(Eigen::Vector3f(0.5f, 1, 3)));
  EXPECT_TRUE(bounds.max().isApprox(Eigen::Vector3f(1.5f, 3, 7)));
}

TEST(Solids, APipeIsAPrismAroundItsAxis) {
  const Vector3d from(1, 1, 1), to(4, 2, 1.5);
  const Mesh mesh = pipe(from, to, 0.1, 8, Material::kMetal);
  const Vector3d axis = (to - from).normalized();
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3d corner = mesh.vertices[mesh.triangles[i][0]].cast<double>() - from;
    const Vector3d radial = corner - corner.dot(axis) * axis;
    EXPECT_NEAR(radial.norm(), 0.1, 1e-5);
    EXPECT_GT(mesh.normal(i).cast<double>().dot(radial), 0.09) << "outwards";
  }
  EXPECT_NEAR(area(mesh), 8 * 2 * 0.1 * std::sin(M_PI / 8) * (to - from).norm(), 1e-3);
  EXPECT_LE(widestTriangle(mesh), 0.3001f);
}

TEST(Solids, APlateFacesItsXAxis) {
  const Pose3 world_T_plate = pose(3, 1, 1.5, 2.2);
  const Mesh mesh = plate(world_T_plate, {0.8, 0.5}, Material::kReflector);
  Vector3d sum = Vector3d::Zero();
  for (size_t i = 0; i < mesh.triangles.size(); ++i)
    EXPECT_TRUE(mesh.normal(i).cast<double>().isApprox(world_T_plate.linear().col(0), 1e-4));
  for (const Eigen::Vector3f& v : mesh.vertices) {
    const Vector3d local = world_T_plate.inverse() * v.cast<double>();
    EXPECT_LE(std::abs(local.y()), 0.4001) << "across";
    EXPECT_LE(std::abs(local.z()), 0.2501) << "up";
    sum += local;
  }
  EXPECT_LT(sum.norm(), 1e-4) << "around its middle";
  EXPECT_NEAR(area(mesh), 0.4, 1e-5);
  EXPECT_LE(widestTriangle(mesh), 0.3001f);
}

TEST(Solids, BouldersAreClosedAndFaceOutwards) {
  Random random(4);
  for (const double radius : {0.12, 0.4, 1.0}) {
    const Vector3d foot(1, 2, 3);
    const Mesh mesh = boulder(foot, radius, random);
    const Vector3d middle = foot + Vector3d(0, 0, 0.4 * radius);
    expectClosed(mesh);
    EXPECT_GT(volume(mesh, middle), 0.5 * std::pow(radius, 3));
    EXPECT_LT(volume(mesh, middle), 8 * std::pow(radius, 3));
    expectFacesOutwards(mesh, middle);
    Eigen::AlignedBox3f bounds;
    for (const Eigen::Vector3f& v : mesh.vertices) bounds.extend(v);
    EXPECT_LT(bounds.min().z(), foot.z()) << "sunk into the floor";
    EXPECT_GT(bounds.max().z(), foot.z() + 0.5 * radius);
  }
}

TEST(Solids, NoTwoBouldersAreAlike) {
  Random random(4);
  const Mesh one = boulder({0, 0, 0}, 0.5, random), two = boulder({0, 0, 0}, 0.5, random);
  EXPECT_FALSE(sameMesh(one, two));
  Random again(4);
  EXPECT_TRUE(sameMesh(one, boulder({0, 0, 0}, 0.5, again)));
}

}  // namespace
}  // namespace lamp::simulation
