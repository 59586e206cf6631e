#include "ClockOffset.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "TestObservations.h"
#include "lamp/frontend/RecordedOdometry.h"

namespace lamp {
namespace {

using namespace test;

/** Of recorded odometry. */
struct Errors {
  double offset_s = 0;  ///< its stamps are later
  double scale = 1.0;   ///< it turns so many times as much
  double noise_deg = 0;
  unsigned seed = 5;
};

/** A minute at 1 m/s; the lidar gives 10 poses a second, recorded odometry 20. */
ClockOffset drive(const std::function<double(double t)>& yaw, const Errors& errors) {
  std::mt19937 random(errors.seed);
  std::normal_distribution<double> unit(0, 1);
  ClockOffset clock;
  RecordedOdometry recorded;
  std::optional<StampedPose> last;
  for (int i = 0; i < 1200; ++i) {
    const double t = 0.05 * i;
    const double when = t - errors.offset_s;
    const double error = errors.noise_deg * kDegree * unit(random);
    recorded.observe(robotPose(kStart + t, planarPose(when, 0, errors.scale * yaw(when) + error)));
    if (i % 2) continue;
    const StampedPose scan{kStart + t, planarPose(t, 0, yaw(t) + 0.05 * kDegree * unit(random))};
    if (last) clock.observe(*last, scan, recorded);
    last = scan;
  }
  return clock;
}

/** Quarter turns to the left and to the right in two seconds each, every six. */
double corners(double t) {
  const int turns = static_cast<int>(std::floor(t / 6));
  const double now = std::clamp((t - 6 * turns) / 2, 0.0, 1.0);
  return 90 * kDegree * ((turns % 2 == 0) ? now : 1 - now);
}

TEST(ClockOffset, IsFoundToATwentiethOfASecond) {
  for (const double offset : {-1.3, -0.5, -0.17, 0.12, 0.5, 1.02}) {
    const ClockOffset clock = drive(corners, {offset});
    ASSERT_TRUE(clock.seconds()) << offset;
    EXPECT_NEAR(*clock.seconds(), offset, 0.03);
    EXPECT_TRUE(clock.wrong()) << offset;
  }
}

TEST(ClockOffset, ClocksThatAgreeAreNotWrong) {
  const ClockOffset clock = drive(corners, {0});
  ASSERT_TRUE(clock.seconds());
  EXPECT_NEAR(*clock.seconds(), 0, 0.02);
  EXPECT_FALSE(clock.wrong());
  EXPECT_FALSE(drive(corners, {0.05}).wrong()) << "as late as readings usually are";
}

TEST(ClockOffset, OdometryThatTurnsTooMuchOrTooLittleIsNotLate) {
  for (const double scale : {0.7, 1.4}) {
    EXPECT_FALSE(drive(corners, {0, scale}).wrong()) << scale;
    const ClockOffset late = drive(corners, {0.5, scale});
    ASSERT_TRUE(late.wrong()) << scale;
    EXPECT_NEAR(*late.wrong(), 0.5, 0.05);
  }
}

TEST(ClockOffset, PoorOdometryIsNotLate) {
  for (unsigned seed = 1; seed <= 4; ++seed)
    for (const double noise_deg : {0.3, 1.0, 3.0}) {
      EXPECT_FALSE(drive(corners, {0, 1, noise_deg, seed}).wrong()) << seed << " " << noise_deg;
      const auto late = drive(corners, {0.5, 1, noise_deg, seed}).wrong();
      ASSERT_TRUE(late || noise_deg > 2) << seed << " " << noise_deg;
      EXPECT_NEAR(late.value_or(0.5), 0.5, 0.05) << seed << " " << noise_deg;
    }
}

TEST(ClockOffset, ARobotThatNeverTurnsOrEvenlyTellsNothing) {
  const auto straight = [](double) { return 0.0; };
  EXPECT_FALSE(drive(straight, {0.5}).seconds());
  EXPECT_FALSE(drive(straight, {0.5}).wrong());
  const auto circle = [](double t) { return 0.5 * t; };
  EXPECT_FALSE(drive(circle, {0.5}).seconds());
}

TEST(ClockOffset, OdometryThatNeverTurnsTellsNothing) {
  EXPECT_FALSE(drive(corners, {0.5, 0}).seconds()) << "it stands, or failed";
}

}  // namespace
}  // namespace lamp
