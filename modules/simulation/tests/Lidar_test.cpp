#include "lamp/simulation/Lidar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <future>

#include "Dust.h"
#include "Reflectance.h"
#include "TestMesh.h"
#include "TestMotion.h"

namespace lamp::simulation {
namespace {

using namespace test;

/** No noise, no losses but for what the world does. */
LidarOptions exactOptions() {
  LidarOptions options;
  options.pose = {0, 0, 0, 0, 0, 0};
  options.azimuth_steps = 360;
  options.range_sigma_m = options.dropout = options.intensity_sigma = options.dust_per_m = 0;
  options.grazing_deg = 89;
  return options;
}

/** Distance from the origin to the wall of a box in a direction. */
double boxRange(const Eigen::Vector3d& half, const Eigen::Vector3d& direction) {
  return (half.array() / direction.array().abs()).minCoeff();
}

bool sameBytes(const LidarSweep& a, const LidarSweep& b) {
  if (a.returns.size() != b.returns.size()) return false;
  for (size_t i = 0; i < a.returns.size(); ++i) {
    const LidarReturn &p = a.returns[i], &q = b.returns[i];
    if (p.stamp != q.stamp || p.range_m != q.range_m || p.intensity != q.intensity ||
        p.point != q.point || p.triangle != q.triangle)
      return false;
  }
  return true;
}

TEST(FiringPattern, TurnsClockwiseSeenFromAbove) {
  const FiringPattern pattern(360, 10, 1);
  const double up = 1.0 * M_PI / 180.0;  // laser 1 looks up by one degree
  const double azimuth = M_PI / 2 + pattern.azimuth(0, 1);
  const Eigen::Vector3f expected(std::cos(up) * std::cos(azimuth),
                                 -std::cos(up) * std::sin(azimuth), std::sin(up));
  EXPECT_LT((pattern.direction(90, 1) - expected).norm(), 1e-6f);
  EXPECT_NEAR(pattern.direction(90, 0).y(), -std::cos(15 * M_PI / 180.0), 1e-6) << "to the right";
}

TEST(FiringPattern, HasTheTimingOfAVlp16) {
  const FiringPattern pattern(1808, 10, 2);
  EXPECT_NEAR(pattern.delay(1, 0), 55.296e-6, 0.02e-6);
  EXPECT_NEAR(pattern.delay(0, 15), 15 * 2.304e-6, 0.02e-6);
  EXPECT_NEAR(pattern.azimuth(1, 0) * 180.0 / M_PI, 0.199, 1e-3);
}

TEST(Lidar, RangesInABoxAreThoseOfGeometry) {
  const Eigen::Vector3d half(4, 3, 2);
  const Mesh mesh = room(half.cast<float>());
  const RayCaster caster(mesh);
  const Lidar lidar(exactOptions(), caster);
  const LidarSweep sweep = lidar.sweep(standing(1), kBegin, 1);
  ASSERT_EQ(sweep.returns.size(), 360u * 16u);
  for (const LidarReturn& r : sweep.returns) {
    const Eigen::Vector3d direction = r.point.cast<double>().normalized();
    EXPECT_NEAR(r.range_m, boxRange(half, direction), 1e-4);
    EXPECT_NEAR(r.point.norm(), r.range_m, 1e-4);
    EXPECT_NEAR(std::asin(direction.z()), FiringPattern::elevation(r.laser), 1e-5);
    EXPECT_NEAR(r.stamp, kBegin + lidar.pattern().delay(r.sequence, r.laser), 1e-6);
    EXPECT_LT(r.triangle, mesh.triangles.size());
  }
}

TEST(Lidar, StandsWhereItsPoseSays) {
  const Mesh mesh = wallAt(5, 50);
  const RayCaster caster(mesh);
  LidarOptions options = exactOptions();
  options.pose = {0.5, 0.2, 0.3, 90, 0, 0};
  const Lidar lidar(options, caster);
  const LidarSweep sweep = lidar.sweep(standing(1), kBegin, 1);
  ASSERT_FALSE(sweep.returns.empty());
  // The sensor looks along the base's y, so the wall before the base is to its right.
  for (const LidarReturn& r : sweep.returns) EXPECT_NEAR(r.point.y(), -4.5, 1e-3);
  for (const auto& p : deskew(sweep, lidar, standing(1), kBegin)) EXPECT_NEAR(p.x(), 5, 1e-3);
}

TEST(Lidar, ReturnsNothingNearerOrFartherThanItsLimits) {
  const Mesh mesh = room({4, 3, 2});
  const RayCaster caster(mesh);
  LidarOptions options = exactOptions();
  options.range_sigma_m = 0.1;
  options.min_range_m = 3.2;
  options.max_range_m = 3.9;
  const auto sweep = Lidar(options, caster).sweep(standing(1), kBegin, 1);
  ASSERT_FALSE(sweep.returns.empty());
  for (const LidarReturn& r : sweep.returns) {
    EXPECT_GE(r.range_m, 3.2f);
    EXPECT_LE(r.range_m, 3.9f);
  }
}

TEST(Lidar, SeesNothingInTheOpen) {
  const Mesh mesh = wallAt(200, 1000);
  const RayCaster caster(mesh);
  EXPECT_TRUE(Lidar(exactOptions(), caster).sweep(standing(1), kBegin, 1).returns.empty());
}

TEST(Lidar, NoiseHasItsSigmaAndNoBias) {
  const Eigen::Vector3d half(4, 3, 2);
  const Mesh mesh = room(half.cast<float>());
  const RayCaster caster(mesh);
  LidarOptions options = exactOptions();
  options.range_sigma_m = 0.02;
  options.dropout = 0.1;
  const auto sweep = Lidar(options, caster).sweep(standing(1), kBegin, 7);
  double sum = 0, squares = 0;
  for (const LidarReturn& r : sweep.returns) {
    const double error = r.range_m - boxRange(half, r.point.cast<double>().normalized());
    sum += error;
    squares += error * error;
  }
  const double count = static_cast<double>(sweep.returns.size());
  EXPECT_NEAR(count / (360 * 16), 0.9, 0.015) << "a tenth is lost";
  EXPECT_NEAR(sum / count, 0, 0.0012);
  EXPECT_NEAR(std::sqrt(squares / count), 0.02, 0.001);
}

TEST(Lidar, SameSeedSameBytes) {
  const Mesh mesh = room({4, 3, 2}, Material::kRock);
  const RayCaster caster(mesh);
  LidarOptions options;
  options.dust_share = 1;
  const Lidar lidar(options, caster);
  const auto truth = steady(1, (Vector6d() << 1, 0, 0, 0, 0, 0.5).finished());
  EXPECT_TRUE(sameBytes(lidar.sweep(truth, kBegin, 7), lidar.sweep(truth, kBegin, 7)));
  EXPECT_FALSE(sameBytes(lidar.sweep(truth, kBegin, 7), lidar.sweep(truth, kBegin, 8)));
  const auto still = standing(1);
  const auto first = lidar.sweep(still, kBegin, 7), second = lidar.sweep(still, kBegin + 0.1, 7);
  EXPECT_NE(first.returns[100].range_m, second.returns[100].range_m) << "noise of its own";
}

TEST(Lidar, ThreadsDoNotChangeASweep) {
  const Mesh mesh = room({4, 3, 2}, Material::kRock);
  const RayCaster caster(mesh);
  const Lidar lidar(LidarOptions(), caster);
  const auto truth = steady(2, (Vector6d() << 1, 0, 0, 0, 0, 0.5).finished());
  const auto sweepAt = [&](int i) { return lidar.sweep(truth, kBegin + 0.1 * i, 7); };
  std::vector<std::future<LidarSweep>> sweeps;
  for (int i = 0; i < 8; ++i) sweeps.push_back(std::async(std::launch::async, sweepAt, i));
  for (int i = 7; i >= 0; --i) EXPECT_TRUE(sameBytes(sweeps[i].get(), sweepAt(i)));
}

TEST(Lidar, MotionBendsAWallAsPredicted) {
  const Mesh mesh = wallAt(10, 50);
  const RayCaster caster(mesh);
  const Lidar lidar(exactOptions(), caster);
  const auto truth = steady(1, (Vector6d() << 2, 0, 0, 0, 0, 0).finished());
  const auto sweep = lidar.sweep(truth, kBegin + 0.5, 1);
  ASSERT_FALSE(sweep.returns.empty());
  for (const LidarReturn& r : sweep.returns)
    EXPECT_NEAR(r.point.x(), 10 - 2 * (r.stamp - kBegin), 1e-3);
}

TEST(Lidar, PointsPutBackWithTheTruePoseAreStraight) {
  const Mesh mesh = room({6, 5, 2});
  const RayCaster caster(mesh);
  for (const char* model : {"spinning", "rotating_mount"}) {
    LidarOptions options = exactOptions();
    options.model = model;
    options.pose = {0.2, -0.1, 0.3, 30, 10, -5};
    const Lidar lidar(options, caster);
    const auto truth = steady(1, (Vector6d() << 2, 0.3, 0.1, 0.3, -0.2, 1.5).finished());
    const auto sweep = lidar.sweep(truth, kBegin + 0.5, 1);
    const double stamp = kBegin + 0.55;
    const auto points = deskew(sweep, lidar, truth, stamp);
    ASSERT_GT(points.size(), 5000u) << model;
    double bent = 0;
    for (size_t i = 0; i < points.size(); ++i) {
      const auto off = [&](const Eigen::Vector3d& world) {
        const Eigen::Array3d gap = (world.array().abs() - Eigen::Array3d(6, 5, 2)).abs();
        return gap.minCoeff();
      };
      EXPECT_LT(off(truth.at(stamp) * points[i].cast<double>()), 2e-3) << model;
      const LidarReturn& r = sweep.returns[i];
      bent =
          std::max(bent, off(truth.at(stamp) * lidar.baseTSensor(stamp) * r.point.cast<double>()));
    }
    EXPECT_GT(bent, 0.1) << "what was not put back is bent: " << model;
  }
}

TEST(Lidar, ARotatingMountSeesAllAround) {
  const Mesh mesh = room({6, 5, 2});
  const RayCaster caster(mesh);
  LidarOptions options = exactOptions();
  options.model = "rotating_mount";
  const Lidar lidar(options, caster);
  const auto truth = standing(3);
  std::vector<int> hits(mesh.triangles.size(), 0);
  for (int i = 0; i < 10; ++i)  // half a turn of the mount
    for (const LidarReturn& r : lidar.sweep(truth, kBegin + 0.1 * i, 1).returns) ++hits[r.triangle];
  for (const int count : hits) EXPECT_GT(count, 100) << "floor and ceiling too";
}

TEST(Lidar, DustTakesTheShareOfItsDensity) {
  const Mesh mesh = room({20, 20, 20});
  const RayCaster caster(mesh);
  LidarOptions options = exactOptions();
  options.azimuth_steps = 1800;
  options.dust_per_m = 0.02;
  options.dust_share = 1;
  options.min_range_m = 0;
  const double stamp = 1.7e9 + 4;  // amid a patch of 10 s
  const double density = dustPerMetre(options, stamp, 3);
  EXPECT_GT(density, 0.01);
  const auto sweep = Lidar(options, caster).sweep(standing(10), stamp, 3);
  double expected = 0, dust = 0;
  for (const LidarReturn& r : sweep.returns) {
    const Eigen::Vector3d direction = r.point.cast<double>().normalized();
    expected += 1.0 - std::exp(-density * boxRange({20, 20, 20}, direction));
    if (!r.fromDust()) continue;
    dust += 1;
    EXPECT_LT(r.intensity, 0.05f);
    EXPECT_LE(r.range_m, boxRange({20, 20, 20}, direction) + 1e-3);
  }
  EXPECT_NEAR(dust / expected, 1.0, 0.05);
}

TEST(Lidar, DustComesInPatchesOfTime) {
  LidarOptions options;
  options.dust_share = 0.3;
  int dusty = 0;
  for (int i = 0; i < 2000; ++i) dusty += dustPerMetre(options, 10.0 * i + 5, 1) > 0;
  EXPECT_NEAR(dusty / 2000.0, 0.3, 0.04);
  EXPECT_NEAR(dustPerMetre(options, 10.0, 1), 0, 1e-9) << "none at the seams";
}

TEST(Lidar, ReflectorsStandOut) {
  LidarOptions options;
  options.azimuth_steps = 900;
  float darkest_reflector = 1, brightest_other = 0;
  for (const float distance : {2.0f, 10.0f, 30.0f})
    for (const Material material :
         {Material::kRock, Material::kConcrete, Material::kMetal, Material::kReflector}) {
      const Mesh mesh = wallAt(distance, distance, material);
      const RayCaster caster(mesh);
      const auto sweep = Lidar(options, caster).sweep(standing(1), kBegin, 1);
      for (const LidarReturn& r : sweep.returns) {
        if (material == Material::kReflector)
          darkest_reflector = std::min(darkest_reflector, r.intensity);
        else
          brightest_other = std::max(brightest_other, r.intensity);
      }
    }
  EXPECT_GT(darkest_reflector, 0.6f);
  EXPECT_LT(brightest_other, 0.5f);
}

TEST(Lidar, RockHasTextureAndConcreteHasNone) {
  float low = 1, high = 0;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3f place(-30 + 0.7f * i, 3, 1);
    const float albedo = albedoOf(Material::kRock, place);
    EXPECT_NEAR(albedo, albedoOf(Material::kRock, place + Eigen::Vector3f(0.01f, 0, 0)), 0.01f);
    low = std::min(low, albedo);
    high = std::max(high, albedo);
    EXPECT_EQ(albedoOf(Material::kConcrete, place), albedoOf(Material::kConcrete, {0, 0, 0}));
  }
  EXPECT_GT(high, 1.3f * low);
}

TEST(Lidar, GrazingFarAndDarkSurfacesFade) {
  const auto chanceOf = [](double incidence_deg, float range_m, Material material) {
    LitSurface surface;
    surface.material = material;
    surface.albedo = material == Material::kRock ? 0.25f : albedoOf(material, {0, 0, 0});
    surface.cos_incidence = static_cast<float>(std::cos(incidence_deg * M_PI / 180.0));
    surface.range_m = range_m;
    return returnProbability(surface, static_cast<float>(std::cos(80 * M_PI / 180.0)), 100);
  };
  EXPECT_NEAR(chanceOf(79.9, 0.1f, Material::kRock), 1.0, 1e-6);
  EXPECT_NEAR(chanceOf(85, 0.1f, Material::kRock), 0.25, 0.01);
  EXPECT_NEAR(chanceOf(0, 100, Material::kRock), 1.0, 1e-6);
  EXPECT_LT(chanceOf(10, 100, Material::kRock), 1.0);
  EXPECT_LT(chanceOf(75, 50, Material::kRock), 0.5);
  EXPECT_LT(chanceOf(75, 50, Material::kMetal), chanceOf(75, 50, Material::kRock));
  EXPECT_NEAR(chanceOf(75, 50, Material::kReflector), 1.0, 1e-6);
}

TEST(Lidar, AnOddTruthGivesNoNan) {
  const Mesh mesh = room({4, 3, 2});
  const RayCaster caster(mesh);
  const TrajectoryInterpolator point({{kBegin, Pose3::Identity()}});
  LidarOptions options = exactOptions();
  options.model = "rotating_mount";
  for (const double stamp : {kBegin - 5, kBegin, kBegin + 5}) {
    const auto sweep = Lidar(options, caster).sweep(point, stamp, 1);
    EXPECT_EQ(sweep.returns.size(), 360u * 16u);
    for (const LidarReturn& r : sweep.returns) EXPECT_TRUE(r.point.allFinite());
  }
}

TEST(Lidar, RefusesOptionsThatMakeNoSense) {
  const Mesh mesh = room({4, 3, 2});
  const RayCaster caster(mesh);
  LidarOptions options;
  options.model = "radar";
  EXPECT_THROW(Lidar(options, caster), std::runtime_error);
  options = {};
  options.pose = {1, 2, 3};
  EXPECT_THROW(Lidar(options, caster), std::runtime_error);
  options = {};
  options.max_range_m = options.min_range_m;
  EXPECT_THROW(Lidar(options, caster), std::runtime_error);
  options = {};
  options.sequences_per_block = 3;
  EXPECT_THROW(Lidar(options, caster), std::runtime_error);
  options = {};
  options.packets_per_observation = 0;
  EXPECT_THROW(Lidar(options, caster), std::runtime_error);
}

}  // namespace
}  // namespace lamp::simulation
