#include "lamp/simulation/Artifacts.h"

#include <gtest/gtest.h>

#include "TestMesh.h"
#include "TestMotion.h"

namespace lamp::simulation {
namespace {

using namespace test;

ArtifactOptions exactOptions() {
  ArtifactOptions options;
  options.range_sigma_m = options.angle_sigma_deg = 0;
  return options;
}

/** Along x from -50 m to 50 m and back, always facing x. */
TrajectoryInterpolator twicePast() {
  return motion(200, [](double t) { return planarPose(t < 100 ? t - 50 : 150 - t, 0, 0); });
}

struct Ground {
  Mesh mesh = wallAt(1000, 1);
  RayCaster caster{mesh};
};

TEST(Artifacts, AreSeenOnceAPassWhereTheyAreNearest) {
  const Ground ground;
  const std::vector<Artifact> artifacts = {{7, "drill", {0, 3, 0}}, {8, "phone", {0, 30, 0}}};
  const auto seen = seeArtifacts(artifacts, twicePast(), ground.caster, exactOptions(), 1);
  ASSERT_EQ(seen.size(), 2u) << "the phone is out of range";
  for (size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].id, 7);
    EXPECT_NEAR(seen[i].stamp - kBegin, i == 0 ? 50 : 150, 0.21);
    EXPECT_NEAR(seen[i].range_m, std::hypot(3, 0.4), 0.02);
    EXPECT_NEAR(seen[i].yaw_rad, M_PI / 2, 0.08) << "to the left";
    EXPECT_NEAR(seen[i].pitch_rad, std::atan2(0.4, 3), 0.01) << "below the camera";
  }
}

TEST(Artifacts, AreNotSeenThroughWalls) {
  Mesh mesh;
  addQuad(mesh, {-100, 2, -5}, {100, 2, -5}, {100, 2, 5}, {-100, 2, 5});
  const RayCaster caster(mesh);
  EXPECT_TRUE(
      seeArtifacts({{7, "drill", {0, 3, 0}}}, twicePast(), caster, exactOptions(), 1).empty());
}

TEST(Artifacts, NoiseHasItsSizeAndItsSeed) {
  const Ground ground;
  std::vector<Artifact> artifacts;
  for (int i = 0; i < 1000; ++i) artifacts.push_back({i, "drill", {0, 3, 0.4}});
  const auto look = [&](uint64_t seed) {
    return seeArtifacts(artifacts, standing(0), ground.caster, {}, seed);
  };
  const auto seen = look(1);
  ASSERT_EQ(seen.size(), 1000u);
  double squares = 0;
  for (const Sighting& s : seen) squares += std::pow(s.range_m - 3, 2);
  EXPECT_NEAR(std::sqrt(squares / 1000), 0.2, 0.02);
  EXPECT_EQ(look(1)[9].range_m, seen[9].range_m);
  EXPECT_NE(look(2)[9].range_m, seen[9].range_m);
}

TEST(Artifacts, NothingToSeeNothingSeen) {
  const Ground ground;
  EXPECT_TRUE(seeArtifacts({}, twicePast(), ground.caster, {}, 1).empty());
  const TrajectoryInterpolator point({{kBegin, Pose3::Identity()}});
  EXPECT_EQ(seeArtifacts({{1, "drill", {2, 0, 0}}}, point, ground.caster, {}, 1).size(), 1u);
}

}  // namespace
}  // namespace lamp::simulation
