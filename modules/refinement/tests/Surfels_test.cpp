#include "lamp/refinement/Surfels.h"

#include <gtest/gtest.h>

#include "TestSurfaces.h"

namespace lamp {
namespace {

using Eigen::Vector3d;

std::vector<SplitSurface> seenFrom(const test::Box& box, const std::vector<Pose3>& poses) {
  std::vector<SplitSurface> surfaces;
  for (size_t i = 0; i < poses.size(); ++i)
    surfaces.push_back(splitSurface(*box.scan(poses[i], static_cast<unsigned>(i))));
  return surfaces;
}

Pose3 at(double x, double y, double z, double yaw = 0) {
  return Eigen::Translation3d(x, y, z) * Pose3(Eigen::AngleAxisd(yaw, Vector3d::UnitZ()));
}

TEST(Surfels, LieOnTheWallsOfABoxAndLookInwards) {
  const test::Box box{{0.3, 0.3, 0.3}, {8.3, 6.3, 3.3}};
  const std::vector<Pose3> poses{at(3, 3, 1), at(5, 2, 1.5, 2)};
  const auto surfels = findSurfels(seenFrom(box, poses), poses, 1.0);
  EXPECT_GT(surfels.size(), 120u);
  size_t right = 0;
  for (const Surfel& surfel : surfels) {
    ASSERT_EQ(surfel.views.size(), 2u);
    const Vector3d p = poses[surfel.views[0].node] * surfel.views[0].node_p_mean;
    Eigen::Index axis;
    const double along = surfel.world_normal.cwiseAbs().maxCoeff(&axis);
    const double level = surfel.world_normal[axis] > 0 ? box.min[axis] : box.max[axis];
    if (along > 0.99 && std::abs(p[axis] - level) < 0.03) ++right;
  }
  // In the corners normals are those of both walls.
  EXPECT_GT(right, 0.8 * static_cast<double>(surfels.size()));
}

TEST(Surfels, FloorAndCeilingInOneCellStayApart) {
  const test::Box box{{0.2, 0.2, 0.1}, {8.2, 6.2, 0.9}};
  const std::vector<Pose3> poses{at(3, 3, 0.5), at(4, 3, 0.5)};
  size_t floor = 0, ceiling = 0;
  for (const Surfel& surfel : findSurfels(seenFrom(box, poses), poses, 1.0)) {
    if (surfel.world_normal.z() > 0.9) ++floor;
    if (surfel.world_normal.z() < -0.9) ++ceiling;
  }
  EXPECT_GT(floor, 20u);
  EXPECT_GT(ceiling, 20u);
}

TEST(Surfels, OneKeyNodeAloneHasNone) {
  const test::Box box{{0, 0, 0}, {8, 6, 3}};
  const std::vector<Pose3> poses{at(3, 3, 1)};
  EXPECT_TRUE(findSurfels(seenFrom(box, poses), poses, 1.0).empty());
}

TEST(Surfels, ScansWithoutPointsAreNoMatter) {
  const std::vector<Pose3> poses{at(3, 3, 1), at(4, 3, 1)};
  EXPECT_TRUE(findSurfels({splitSurface(Scan{}), splitSurface(Scan{})}, poses, 1.0).empty());
  EXPECT_TRUE(findSurfels({}, {}, 1.0).empty());
}

TEST(Surfels, AnEighthOfTheSurfaceIsHeldBack) {
  const test::Box box{{0, 0, 0}, {12, 12, 3}};
  const SplitSurface split = splitSurface(*box.scan(at(6, 6, 1), 1));
  const auto held_back = static_cast<double>(split.held_back.points.size());
  EXPECT_NEAR(held_back / (held_back + static_cast<double>(split.used.points.size())), 0.125, 0.04);
}

}  // namespace
}  // namespace lamp
