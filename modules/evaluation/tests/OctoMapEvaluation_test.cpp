#include "lamp/evaluation/OctoMapEvaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <fstream>
#include <set>
#include <sstream>

#include "TestClouds.h"
#include "TestRuns.h"
#include "lamp/evaluation/FreeSpace.h"

namespace lamp::evaluation {
namespace {

using namespace test;
using testing::HasSubstr;

constexpr double kVoxel = 0.2;

/** A room of 4 m x 3 m x 2 m: 20 x 15 x 10 voxels, of which 18 x 13 x 8 are inside. */
SurfaceSamples room() {
  return box({4, 3, 2});
}
constexpr size_t kSurface = 20 * 15 * 10 - 18 * 13 * 8;
constexpr size_t kTrulyFree = 16 * 11 * 6;  ///< one voxel away from all walls

const std::vector<Eigen::Vector3f> kDriven = {{1, 1.5f, 0.5f}, {2, 1.5f, 0.5f}, {3, 1.5f, 0.5f}};

octomap::point3d center(int x, int y, int z) {
  return {static_cast<float>(kVoxel * (x + 0.5)), static_cast<float>(kVoxel * (y + 0.5)),
          static_cast<float>(kVoxel * (z + 0.5))};
}

/** The octree that is right in every voxel. */
octomap::OcTree rightTree() {
  octomap::OcTree tree(kVoxel);
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 15; ++y)
      for (int z = 0; z < 10; ++z) {
        const bool wall = x == 0 || x == 19 || y == 0 || y == 14 || z == 0 || z == 9;
        tree.setNodeValue(center(x, y, z), wall ? 2.0f : -2.0f);
      }
  return tree;
}

std::string written(octomap::OcTree tree, const std::string& name = "map.bt") {
  const std::string path = freshFolder() + "/" + name;
  if (name == "map.bt")
    tree.writeBinary(path);
  else
    tree.write(path);
  return path;
}

OctoMapEvaluation evaluate(const std::string& path, const Pose3& T = Pose3::Identity(),
                           const std::vector<Eigen::Vector3f>& moving = {}) {
  return evaluateOctoMap(path, T, room(), kDriven, moving);
}

TEST(OctoMapEvaluation, ARightMapHasNothingWrong) {
  for (const char* name : {"map.bt", "map.ot"}) {
    const auto e = evaluate(written(rightTree(), name));
    EXPECT_NEAR(e.resolution_m, kVoxel, 1e-9);
    EXPECT_EQ(e.surface.occupied, kSurface);
    EXPECT_EQ(e.surface.total(), kSurface);
    EXPECT_EQ(e.free_space.free, kTrulyFree);
    EXPECT_EQ(e.free_space.total(), kTrulyFree);
    EXPECT_EQ(e.driven_floor.unknown, 0u);
    EXPECT_GT(e.driven_floor.occupied, 0u);
    EXPECT_EQ(e.no_free_space, "");
  }
}

TEST(OctoMapEvaluation, AnOffsetInTheHeaderIsPartOfTheMapsPlace) {
  for (const char* name : {"map.bt", "map.ot"}) {
    const std::string path = written(rightTree(), name);
    std::string bytes = readTextFile(path);
    writeTextFile(path, bytes.insert(bytes.find('\n') + 1, "# offset 431000 5412000 0\n"));
    const auto e = evaluate(path, Pose3(Eigen::Translation3d(-431000, -5412000, 0)));
    EXPECT_EQ(e.surface.occupied, kSurface);
    EXPECT_EQ(e.free_space.free, kTrulyFree);
  }
}

TEST(OctoMapEvaluation, CountsVoxelsThatAreWrong) {
  octomap::OcTree tree = rightTree();
  for (int i = 3; i < 10; ++i) tree.setNodeValue(center(i, 0, 5), -2.0f);  // 7 of the wall
  for (int i = 5; i < 8; ++i) tree.setNodeValue(center(i, 6, 5), 2.0f);    // 3 within the room
  tree.setNodeValue(center(1, 6, 5), 2.0f);  // beside the wall: nobody is punished for rounding
  tree.deleteNode(center(4, 0, 2));          // one of the wall is unknown
  const auto e = evaluate(written(tree));
  EXPECT_EQ(e.surface.free, 7u);
  EXPECT_EQ(e.surface.unknown, 1u);
  EXPECT_EQ(e.surface.occupied, kSurface - 8);
  EXPECT_EQ(e.free_space.occupied, 3u);
  EXPECT_EQ(e.free_space.free, kTrulyFree - 3);
}

TEST(OctoMapEvaluation, CountsVoxelsOfWhatMovesOnce) {
  octomap::OcTree tree = rightTree();
  tree.setNodeValue(center(5, 6, 5), 2.0f);
  const auto at = [](float x) { return Eigen::Vector3f(x, 1.3f, 1.1f); };
  const auto e = evaluate(written(tree), Pose3::Identity(), {at(1.05f), at(1.1f), at(1.3f), at(9)});
  EXPECT_EQ(e.moving.occupied, 1u);
  EXPECT_EQ(e.moving.free, 1u);
  EXPECT_EQ(e.moving.unknown, 1u);
}

TEST(OctoMapEvaluation, DrivenFloorIsBelowTheWayOnly) {
  octomap::OcTree tree = rightTree();
  tree.deleteNode(center(5, 7, 0));   // on the way: four samples
  tree.deleteNode(center(5, 13, 0));  // 1.2 m beside it
  const auto e = evaluate(written(tree));
  EXPECT_EQ(e.driven_floor.unknown, 4u);
  // Samples within 0.5 m of the three places, counted one by one.
  size_t expected = 0;
  for (int x = 0; x < 40; ++x)
    for (int y = 0; y < 30; ++y) {
      bool near = false;
      for (const auto& p : kDriven)
        near = near || std::hypot(0.1 * x + 0.05 - p.x(), 0.1 * y + 0.05 - p.y()) < 0.5;
      expected += near;
    }
  EXPECT_EQ(e.driven_floor.total(), expected);
}

TEST(OctoMapEvaluation, AnAlignedMapIsAskedInItsOwnFrame) {
  octomap::OcTree moved(kVoxel);  // by 1 m in x, that is 5 voxels
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 15; ++y)
      for (int z = 0; z < 10; ++z) {
        const bool wall = x == 0 || x == 19 || y == 0 || y == 14 || z == 0 || z == 9;
        moved.setNodeValue(center(x + 5, y, z), wall ? 2.0f : -2.0f);
      }
  const std::string path = written(moved);
  EXPECT_GT(evaluate(path).surface.free, 0u);
  const auto e = evaluate(path, pose(-1, 0, 0));
  EXPECT_EQ(e.surface.occupied, kSurface);
  EXPECT_EQ(e.free_space.free, kTrulyFree);
}

TEST(OctoMapEvaluation, DamagedTreesAreErrors) {
  const std::string path = written(rightTree());
  const std::string whole = readTextFile(path);
  for (const std::string& content :
       {std::string(), std::string("no octree"), whole.substr(0, whole.size() / 2)}) {
    writeTextFile(path, content);
    EXPECT_THAT(thrownBy([&] { evaluate(path); }), HasSubstr("map.bt' is not an OctoMap"))
        << content.size();
  }
}

size_t freeVoxels(const SurfaceSamples& surface, const std::vector<Eigen::Vector3f>& positions) {
  size_t count = 0;
  forEachFreeVoxel(surface, positions, kVoxel, [&](const Eigen::Vector3d&) { ++count; });
  return count;
}

TEST(FreeSpace, IsWhatTheRobotsCouldReach) {
  EXPECT_EQ(freeVoxels(room(), kDriven), kTrulyFree);
  EXPECT_EQ(freeVoxels(room(), {}), 0u);
  EXPECT_EQ(freeVoxels(room(), {{100, 0, 0}}), 0u) << "a robot outside of what was seen";
  EXPECT_EQ(freeVoxels(room(), {{2, 1, 0.1f}}), kTrulyFree) << "a base on the ground";
  EXPECT_EQ(freeVoxels(room(), {{2, 1, -0.1f}}), kTrulyFree) << "a base below it, and outside";
  EXPECT_EQ(freeVoxels(room(), {{2, 1, 0.3f}}), kTrulyFree) << "a base just above it";
  SurfaceSamples outside = room();
  addLevel(-4, 8, -4, 8, -2, 1, outside);  // makes the box larger, so that there is an outside
  EXPECT_EQ(freeVoxels(outside, {{2, 1, 0.1f}, {2, 2, -0.1f}}), kTrulyFree);
  SurfaceSamples divided = room();
  addWall(true, 2.1f, 0, 3, 0, 2, divided);  // in voxel 10 of 20
  EXPECT_EQ(freeVoxels(divided, {{1, 1.5f, 1}}), 7u * 11 * 6);
  EXPECT_EQ(freeVoxels(divided, {{3, 1.5f, 1}}), 6u * 11 * 6);
}

TEST(FreeSpace, ASlantedWallIsWatertight) {
  SurfaceSamples world = room();
  // A plane through the room, 25 degrees off the grid, in samples of at most 0.1 m.
  const Eigen::Vector3f along(std::cos(1.1f), std::sin(1.1f), 0);
  for (float s = -4; s < 4; s += 0.1f)
    for (float z = 0.05f; z < 2; z += 0.1f) {
      const Eigen::Vector3f p = Eigen::Vector3f(2, 1.5f, z) + s * along;
      if (p.x() < 0 || p.x() > 4 || p.y() < 0 || p.y() > 3) continue;
      world.points.push_back(p);
      world.normals.emplace_back(along.y(), -along.x(), 0);
      world.seen.push_back(1);
    }
  std::set<bool> sides;
  forEachFreeVoxel(world, {{0.7f, 2.0f, 1}}, kVoxel, [&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d d = p - Eigen::Vector3d(2, 1.5, p.z());
    sides.insert(d.x() * along.y() - d.y() * along.x() > 0);
  });
  EXPECT_EQ(sides.size(), 1u);
}

}  // namespace
}  // namespace lamp::evaluation
