#include "lamp/simulation/Radio.h"

#include <gtest/gtest.h>

#include "TestMesh.h"
#include "TestMotion.h"

namespace lamp::simulation {
namespace {

using namespace test;

RadioOptions withoutShadowing() {
  RadioOptions options;
  options.shadowing_db = 0;
  return options;
}

TrajectoryInterpolator straight(double seconds, double speed = 1) {
  return motion(seconds, [=](double t) { return planarPose(speed * t, 0, 0); });
}

TEST(Radio, BeaconsAreDroppedAlongTheWay) {
  const auto beacons = dropBeacons(straight(100), "husky1", 30);
  ASSERT_EQ(beacons.size(), 3u);
  for (size_t i = 0; i < beacons.size(); ++i) {
    EXPECT_EQ(beacons[i].name, "husky1-" + std::to_string(i));
    EXPECT_NEAR(beacons[i].position.x(), 30.0 * (i + 1), 0.5);
    EXPECT_NEAR(beacons[i].since - kBegin, beacons[i].position.x(), 1e-6);
  }
  EXPECT_TRUE(dropBeacons(standing(100), "husky1", 30).empty());
}

TEST(Radio, LossGrowsWithTheLogarithmOfTheDistance) {
  const Mesh mesh = wallAt(50, 20);
  const RayCaster caster(mesh);
  const Radio radio(withoutShadowing(), caster);
  EXPECT_NEAR(radio.expectedLoss({0, 0, 0}, {1, 0, 0}), 40, 1e-9);
  EXPECT_NEAR(radio.expectedLoss({0, 0, 0}, {10, 0, 0}), 62, 1e-9);
  EXPECT_LT(radio.expectedLoss({0, 0, 0}, {8, 0, 0}), 60) << "a fly-by";
  EXPECT_NEAR(radio.expectedLoss({45, 0, 0}, {55, 0, 0}), 62 + 25, 1e-9) << "through the wall";
  EXPECT_TRUE(std::isfinite(radio.expectedLoss({0, 0, 0}, {0, 0, 0})));
}

TEST(Radio, OnlyBeaconsThatAreThereAndNearAreHeard) {
  const Mesh mesh = wallAt(500, 20);
  const RayCaster caster(mesh);
  const Radio radio(withoutShadowing(), caster);
  const std::vector<Beacon> beacons = {
      {"a-0", {0, 0, 0}, kBegin}, {"a-1", {100, 0, 0}, kBegin + 90}, {"a-2", {1000, 0, 0}, kBegin}};
  int heard[3] = {0, 0, 0};
  double last = 0;
  for (const RssiReading& r : radio.listen(straight(100), beacons, 1)) {
    ++heard[r.beacon];
    EXPECT_GE(r.stamp, last);
    EXPECT_GE(r.stamp, beacons[r.beacon].since);
    last = r.stamp;
  }
  EXPECT_EQ(heard[0], 81) << "up to 80 m";
  EXPECT_EQ(heard[1], 11) << "only after it was dropped";
  EXPECT_EQ(heard[2], 0);
}

TEST(Radio, ShadowingHasItsSigmaAndItsSeed) {
  const Mesh mesh = wallAt(500, 20);
  const RayCaster caster(mesh);
  const Radio radio(RadioOptions(), caster);
  const std::vector<Beacon> beacons = {{"a-0", {10, 0, 0}, kBegin}};
  const auto readings = radio.listen(standing(2000), beacons, 1);
  double sum = 0, squares = 0;
  for (const RssiReading& r : readings) {
    sum += r.path_loss_db - 62;
    squares += std::pow(r.path_loss_db - 62, 2);
  }
  EXPECT_NEAR(sum / readings.size(), 0, 0.3);
  EXPECT_NEAR(std::sqrt(squares / readings.size()), 3, 0.2);
  EXPECT_EQ(radio.listen(standing(9), beacons, 1).back().path_loss_db,
            radio.listen(standing(9), beacons, 1).back().path_loss_db);
  EXPECT_NE(radio.listen(standing(9), beacons, 1).back().path_loss_db,
            radio.listen(standing(9), beacons, 2).back().path_loss_db);
}

}  // namespace
}  // namespace lamp::simulation
