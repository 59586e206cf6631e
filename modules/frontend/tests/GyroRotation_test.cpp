#include "GyroRotation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "TestObservations.h"

namespace lamp {
namespace {

using namespace test;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

InputObservation gyros(double stamp, const Eigen::Vector3d& rate,
                       const std::string& label = "imu") {
  auto imu = std::make_shared<mrpt::obs::CObservationIMU>();
  using namespace mrpt::obs;
  imu->set(IMU_X_ACC, 0);
  imu->set(IMU_Y_ACC, 0);
  imu->set(IMU_Z_ACC, 9.81);
  imu->set(IMU_WX, rate.x());
  imu->set(IMU_WY, rate.y());
  imu->set(IMU_WZ, rate.z());
  return wrapped(stamp, label, imu);
}

MeasuredRotation yawed(double angle, double sigma = 0.002) {
  return {Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix(), sigma};
}

/** Turns to and fro. \param sign of what the unit says; \param bias of it, rad/s. */
void turnToAndFro(GyroRotation& rotation, double sign, double bias, int scans = 300) {
  const auto rate = [](double t) { return std::sin(t); };
  const auto yaw = [](double t) { return 1 - std::cos(t); };
  int next = 0;
  for (int k = 0; k <= scans; ++k) {
    const double stamp = 0.1 * k;
    for (; next * 0.01 <= stamp + 1e-9; ++next)
      rotation.observe(gyros(kStart + next * 0.01, {0, 0, sign * rate(next * 0.01) + bias}));
    rotation.compare(kStart + stamp, yawed(yaw(stamp)));
  }
}

TEST(GyroRotation, IntegratesRatesBetweenAnyTwoMoments) {
  GyroRotation rotation;
  EXPECT_FALSE(rotation.between(kStart, kStart + 1));
  for (int i = 0; i <= 100; ++i)  // about a tilted axis
    rotation.observe(gyros(kStart + 0.01 * i, {0.3, 0, 0.4}));
  const auto turn = rotation.between(kStart + 0.123, kStart + 0.876);
  ASSERT_TRUE(turn);
  const Eigen::AngleAxisd truth(0.5 * 0.753, Eigen::Vector3d(0.6, 0, 0.8));
  EXPECT_LT((turn->rotation - truth.toRotationMatrix()).norm(), 1e-6) << "stamps end there";
  const auto back = rotation.between(kStart + 0.876, kStart + 0.123);
  ASSERT_TRUE(back);
  EXPECT_LT((turn->rotation * back->rotation - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_GT(turn->sigma_rad, 0);
  EXPECT_LT(turn->sigma_rad, 0.05);
}

TEST(GyroRotation, KnowsNothingOfGapsAndOfWhatLiesBeyond) {
  GyroRotation rotation;
  for (int i = 0; i <= 200; ++i)
    if (i < 50 || i > 100) rotation.observe(gyros(kStart + 0.01 * i, {0, 0, 1}));
  EXPECT_TRUE(rotation.between(kStart, kStart + 0.4));
  EXPECT_FALSE(rotation.between(kStart + 0.4, kStart + 1.2));
  EXPECT_FALSE(rotation.between(kStart + 1.9, kStart + 3));
  EXPECT_FALSE(rotation.between(kStart - 3, kStart + 0.3));
  EXPECT_TRUE(rotation.covers(kStart + 2));
  EXPECT_FALSE(rotation.covers(kStart + 3));
}

TEST(GyroRotation, LearnsTheBiasFromTheLidar) {
  GyroRotation rotation;
  turnToAndFro(rotation, 1, 0.02);
  const auto turn = rotation.between(kStart + 28, kStart + 29);
  ASSERT_TRUE(turn);
  const double truth = std::cos(28.0) - std::cos(29.0);
  EXPECT_NEAR(Eigen::AngleAxisd(turn->rotation).angle(), std::abs(truth), 0.003)
      << "0.02 with the bias";
  EXPECT_THAT(rotation.warnings(), IsEmpty());
}

TEST(GyroRotation, IsGivenUpIfMountedUpsideDown) {
  GyroRotation rotation;
  turnToAndFro(rotation, -1, 0);
  EXPECT_FALSE(rotation.between(kStart + 28, kStart + 29));
  EXPECT_TRUE(rotation.covers(kStart + 1000)) << "nobody waits for it";
  EXPECT_THAT(rotation.warnings(), Contains(HasSubstr("'imu' are not used")));
}

TEST(GyroRotation, OneUnitIsEnough) {
  GyroRotation rotation;
  rotation.observe(gyros(kStart, {0, 0, 1}));
  rotation.observe(gyros(kStart + 0.01, {0, 0, -1}, "other"));
  rotation.observe(gyros(kStart + 0.02, {0, 0, 1}));
  rotation.observe(gyros(kStart + 0.02, {0, 0, -1}));
  const auto turn = rotation.between(kStart, kStart + 0.02);
  ASSERT_TRUE(turn);
  EXPECT_NEAR(Eigen::AngleAxisd(turn->rotation).angle(), 0.02, 1e-6);
}

TEST(GyroRotation, AnotherSensorIsNone) {
  GyroRotation rotation;
  rotation.observe(wheels(kStart, 0));
  EXPECT_TRUE(rotation.covers(kStart + 100));
  EXPECT_FALSE(rotation.between(kStart, kStart + 0.1));
}

}  // namespace
}  // namespace lamp
