#include "lamp/simulation/Imu.h"

#include <gtest/gtest.h>

#include "TestMotion.h"

namespace lamp::simulation {
namespace {

using namespace test;
using Eigen::Vector3d;

ImuOptions exactOptions() {
  ImuOptions options;
  options.gyro_sigma_rad_s = options.gyro_bias_rad_s = 0;
  options.accel_sigma_m_s2 = options.accel_bias_m_s2 = 0;
  return options;
}

void expectNear(const Vector3d& a, const Vector3d& b, double tolerance) {
  EXPECT_LT((a - b).norm(), tolerance) << a.transpose() << " / " << b.transpose();
}

TEST(Imu, FeelsGravityAtRest) {
  Vector6d tilted = Vector6d::Zero();
  tilted[4] = M_PI / 6;  // nose down
  const auto readings = simulateImu(standing(1, poseFromYawPitchRoll(tilted)), exactOptions(), 1);
  ASSERT_EQ(readings.size(), 101u);
  for (const auto& r : readings) {
    expectNear(r.angular_velocity, Vector3d::Zero(), 1e-9);
    expectNear(r.specific_force, kGravity_m_s2 * Vector3d(-0.5, 0, std::sqrt(0.75)), 1e-9);
  }
}

TEST(Imu, FeelsTurningAndCentripetalForce) {
  const auto truth = steady(2, (Vector6d() << 2, 0, 0, 0, 0, 0.5).finished());
  const auto readings = simulateImu(truth, exactOptions(), 1);
  ASSERT_EQ(readings.size(), 201u);
  for (size_t i = 20; i + 20 < readings.size(); ++i) {
    expectNear(readings[i].angular_velocity, {0, 0, 0.5}, 1e-4);
    expectNear(readings[i].specific_force, {0, 2 * 0.5, kGravity_m_s2}, 1e-3);
  }
  expectNear(readings.front().angular_velocity, {0, 0, 0.5}, 1e-4);
}

TEST(Imu, FeelsSpeedingUp) {
  const auto truth = motion(2, [](double t) { return planarPose(0.5 * 3.0 * t * t, 0, 0); });
  const auto readings = simulateImu(truth, exactOptions(), 1);
  ASSERT_EQ(readings.size(), 201u);
  for (const auto& r : readings) expectNear(r.specific_force, {3, 0, kGravity_m_s2}, 1e-3);
}

TEST(Imu, AccelerationIsSmoothOverACoarseTruth) {
  std::vector<StampedPose> samples;  // every 0.1 s, constant twist between
  for (int i = 0; i <= 20; ++i)
    samples.push_back({kBegin + 0.1 * i, planarPose(0.015 * i * i, 0, 0)});
  const auto readings = simulateImu(TrajectoryInterpolator(samples), exactOptions(), 1);
  ASSERT_EQ(readings.size(), 201u);
  for (const auto& r : readings) expectNear(r.specific_force, {3, 0, kGravity_m_s2}, 1e-3);
}

TEST(Imu, NoiseAndBiasHaveTheirSizes) {
  ImuOptions options;
  options.bias_time_s = 1e6;
  double noise = 0, bias = 0;
  for (int seed = 0; seed < 100; ++seed) {
    const auto readings = simulateImu(standing(2), options, seed);
    double mean = 0, squares = 0;
    for (const auto& r : readings) mean += r.angular_velocity.y() / readings.size();
    for (const auto& r : readings)
      squares += std::pow(r.angular_velocity.y() - mean, 2) / readings.size();
    noise += squares / 100;
    bias += mean * mean / 100;
  }
  EXPECT_NEAR(std::sqrt(noise), options.gyro_sigma_rad_s, 0.05 * options.gyro_sigma_rad_s);
  EXPECT_NEAR(std::sqrt(bias), options.gyro_bias_rad_s, 0.25 * options.gyro_bias_rad_s);
}

TEST(Imu, SameSeedSameReadings) {
  const auto a = simulateImu(winding(5), {}, 1), b = simulateImu(winding(5), {}, 1);
  const auto c = simulateImu(winding(5), {}, 2);
  EXPECT_EQ(a.back().specific_force, b.back().specific_force);
  EXPECT_NE(a.back().specific_force, c.back().specific_force);
}

TEST(Imu, ATruthOfOnePoseIsRest) {
  const auto readings =
      simulateImu(TrajectoryInterpolator({{kBegin, Pose3::Identity()}}), exactOptions(), 1);
  ASSERT_EQ(readings.size(), 1u);
  expectNear(readings[0].specific_force, {0, 0, kGravity_m_s2}, 1e-9);
}

}  // namespace
}  // namespace lamp::simulation
