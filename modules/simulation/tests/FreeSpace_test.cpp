#include "lamp/simulation/FreeSpace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "TestHollow.h"

namespace lamp::simulation {
namespace {

using namespace test;
using Eigen::Vector3d;

FreeSpace::Parts allOf(const FreeSpace& space) {
  return space.partsIn(space.bounds());
}

std::vector<Vector3d> pointsIn(const Eigen::AlignedBox3d& box, size_t count) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Vector3d> points;
  for (size_t i = 0; i < count; ++i)
    points.push_back(
        box.min() +
        Vector3d(share(random), share(random), share(random)).cwiseProduct(box.sizes()));
  return points;
}

TEST(FreeSpace, AHollowIsARoundedBox) {
  const RoundedBox box;
  FreeSpace space(1);
  space.add(box.hollow());
  for (const Vector3d& p : pointsIn(space.bounds(), 5000)) {
    const double distance = space.smooth(p, allOf(space)).distance_m;
    EXPECT_NEAR(distance, box.distance(p), 1e-9);
  }
}

TEST(FreeSpace, BoundsHoldTheHollow) {
  const RoundedBox box;
  FreeSpace space(1);
  space.add(box.hollow());
  Eigen::AlignedBox3d wide = space.bounds();
  wide.extend(wide.min() - Vector3d::Ones());
  wide.extend(wide.max() + Vector3d::Ones());
  for (const Vector3d& p : pointsIn(wide, 5000))
    EXPECT_TRUE(box.distance(p) >= 0 || space.bounds().contains(p));
}

TEST(FreeSpace, SeveralHollowsAreTheirUnion) {
  const Hollow a = hollow({0, 0, 0}, {10, 0, 0}), b = hollow({5, -6, 0}, {5, 6, 0});
  FreeSpace both(1), only_a(1), only_b(1);
  both.add(a);
  both.add(b);
  only_a.add(a);
  only_b.add(b);
  for (const Vector3d& p : pointsIn(both.bounds(), 3000))
    EXPECT_NEAR(both.smooth(p, allOf(both)).distance_m,
                std::min(only_a.smooth(p, allOf(only_a)).distance_m,
                         only_b.smooth(p, allOf(only_b)).distance_m),
                1e-9);
}

TEST(FreeSpace, BlendingOnlyTakesRockAwayAndOnlyAtTheCorner) {
  FreeSpace sharp(1), blended(1);
  for (Hollow drive : {hollow({0, 0, 0}, {10, 0, 0}), hollow({5, -6, 0}, {5, 6, 0})}) {
    sharp.add(drive);
    drive.style.blend_m = 1;
    blended.add(drive);
  }
  for (const Vector3d& p : pointsIn(sharp.bounds(), 3000)) {
    const double change =
        blended.smooth(p, allOf(blended)).distance_m - sharp.smooth(p, allOf(sharp)).distance_m;
    EXPECT_LE(change, 0);
    EXPECT_GE(change, -0.25);
  }
  const Vector3d corner(3.5, 1.5, 1.5), far(1.5, 1.5, 1.5);
  EXPECT_LT(blended.smooth(corner, allOf(blended)).distance_m, -0.2);
  EXPECT_NEAR(blended.smooth(far, allOf(blended)).distance_m, 0, 1e-9);
}

TEST(FreeSpace, PillarsAreRock) {
  FreeSpace space(1);
  space.add(hollow({0, 0, 0}, {20, 0, 0}, 20));
  space.add(Pillar{{5, 2, -1}, 0.5, 10, false});
  space.add(Pillar{{12, 2, -1}, 0.5, 10, true});
  const auto at = [&](double x, double y) {
    return space.smooth({x, y, 1.5}, allOf(space)).distance_m;
  };
  EXPECT_NEAR(at(5, 2), 0.5, 1e-9);
  EXPECT_NEAR(at(5.9, 2), -0.4, 1e-9);
  EXPECT_NEAR(at(5.4, 2.4), 0.5 - std::hypot(0.4, 0.4), 1e-9) << "a round one";
  EXPECT_NEAR(at(12.4, 2.4), 0.1, 1e-9) << "a square one";
}

TEST(FreeSpace, PartsInABoxAreThoseThatReachIt) {
  FreeSpace space(1);
  for (const double y : {0.0, 10.0, 20.0}) {
    space.add(hollow({0, y, 0}, {30, y, 0}));
    space.add(Pillar{{15, y, 0}, 0.3, 3, false});
  }
  const auto parts = space.partsIn({Vector3d(10, 9, 0), Vector3d(12, 11, 2)});
  EXPECT_EQ(parts.hollows, std::vector<size_t>{1});
  EXPECT_TRUE(parts.pillars.empty());
  EXPECT_TRUE(space.partsIn({Vector3d(10, 4, 0), Vector3d(12, 6, 2)}).hollows.empty());
  EXPECT_EQ(space.partsIn({Vector3d(14, 19, 0), Vector3d(16, 21, 2)}).pillars,
            std::vector<size_t>{2});
}

TEST(FreeSpace, RoughnessMovesWallsByNoMoreThanItSaysAndFloorsLess) {
  FreeSpace space(9);
  space.add(hollow({0, 0, 0}, {60, 0, 0}, 5, 3, {0.3, 0.4, 0.2, 0, Material::kRock}));
  double wall = 0, floor = 0;
  int count = 0;
  for (double x = 2; x < 58; x += 0.37, ++count) {
    const auto change = [&](const Vector3d& p) {
      const FreeSpace::Sample sample = space.smooth(p, allOf(space));
      return space.rough(p, sample) - sample.distance_m;
    };
    const double at_wall = change({x, 2.5, 1.5}), at_floor = change({x, 0.3, 0});
    EXPECT_LE(std::abs(at_wall), space.roughness());
    wall += at_wall * at_wall;
    floor += at_floor * at_floor;
  }
  EXPECT_GT(std::sqrt(wall / count), 0.05) << "it is no smooth wall";
  EXPECT_LT(std::sqrt(floor / count), 0.5 * std::sqrt(wall / count));
}

}  // namespace
}  // namespace lamp::simulation
