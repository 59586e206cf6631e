#include "lamp/scans/Slide.h"

#include <gtest/gtest.h>

#include "TestCorridors.h"

namespace lamp {
namespace {

const TestLidar kLidar{32, 1024, 60, 0.01};
const Eigen::Vector3d kAxis = Eigen::Vector3d::UnitX();

PreparedScanPtr scanAt(double x_m, double end_m, unsigned seed) {
  SmoothCorridor corridor;
  corridor.end_m = end_m;
  return prepareScan(scanOf(corridor, kLidar, x_m, seed), 10, false);
}

TEST(Slide, BringsTheWallThatBothSeeOntoItself) {
  const auto target = scanAt(0, 18, 1), source = scanAt(6, 18, 2);
  const auto slide = slideOntoSurfacesAcross(*source, *target, Pose3::Identity(), kAxis);
  ASSERT_TRUE(slide.has_value());
  EXPECT_NEAR(*slide, 6, 0.3);
  const auto back = slideOntoSurfacesAcross(*source, *target, Pose3::Identity(), -kAxis);
  ASSERT_TRUE(back.has_value());
  EXPECT_NEAR(*back, -6, 0.3);
}

TEST(Slide, IsNoneWhereTheWallLiesOnItself) {
  const auto target = scanAt(0, 18, 1), source = scanAt(6, 18, 2);
  const Pose3 right(Eigen::Translation3d(6, 0, 0));
  EXPECT_FALSE(slideOntoSurfacesAcross(*source, *target, right, kAxis).has_value());
}

TEST(Slide, IsNoneWhereOnlyOneSeesTheWall) {
  const auto target = scanAt(0, 80, 1), source = scanAt(65, 80, 2);
  EXPECT_FALSE(slideOntoSurfacesAcross(*source, *target, Pose3::Identity(), kAxis).has_value());
}

TEST(Slide, IsNoneOfNothing) {
  const auto none = prepareScan({}, 10, false), some = scanAt(0, 18, 1);
  EXPECT_FALSE(slideOntoSurfacesAcross(*none, *some, Pose3::Identity(), kAxis).has_value());
  EXPECT_FALSE(slideOntoSurfacesAcross(*some, *none, Pose3::Identity(), kAxis).has_value());
}

}  // namespace
}  // namespace lamp
