#include "OdometryChain.h"

#include <gtest/gtest.h>

#include "TestHall.h"
#include "TestObservations.h"
#include "lamp/frontend/LidarOdometry.h"
#include "lamp/frontend/RecordedOdometry.h"

namespace lamp {
namespace {

using namespace test;

OdometryChain chain(bool lidar, bool recorded, bool keyed = false) {
  std::vector<std::shared_ptr<OdometrySource>> sources;
  if (lidar) sources.push_back(std::make_shared<LidarOdometry>());
  if (recorded) sources.push_back(std::make_shared<RecordedOdometry>());
  return {std::move(sources), keyed, MotionModelOptions()};
}

TEST(OdometryChain, WaitsForRecordedOdometry) {
  OdometryChain odometry = chain(true, true);
  odometry.observe(wheels(kStart, 0));
  EXPECT_FALSE(odometry.ready(kStart + 0.1));
  odometry.observe(wheels(kStart + 0.2, 0.2));
  EXPECT_TRUE(odometry.ready(kStart + 0.1));
  EXPECT_TRUE(odometry.tracks());
  EXPECT_NEAR(odometry.motion(kStart, kStart + 0.1).translation().x(), 0.1, 1e-6);
}

TEST(OdometryChain, DoesNotWaitForeverWhereTheLidarCanTell) {
  OdometryChain odometry = chain(true, true);
  odometry.observe(cloud(kStart, somePoints()));
  EXPECT_FALSE(odometry.ready(kStart));
  odometry.observe(cloud(kStart + 5, somePoints()));
  EXPECT_TRUE(odometry.ready(kStart));
  EXPECT_TRUE(odometry.tracks());
}

TEST(OdometryChain, WaitsByTheClockOfTheLidar) {
  OdometryChain odometry = chain(true, true);
  odometry.observe(cloud(kStart, somePoints()));
  odometry.observe(wrapped(kStart + 5, "imu", mrpt::obs::CObservationIMU::Create()));
  EXPECT_FALSE(odometry.ready(kStart)) << "the inertial unit has another clock";
}

TEST(OdometryChain, WaitsForAsLongAsItTakesWithoutTheLidar) {
  OdometryChain odometry = chain(false, true);
  odometry.observe(cloud(kStart, somePoints()));
  odometry.observe(cloud(kStart + 500, somePoints()));
  EXPECT_FALSE(odometry.ready(kStart));
  EXPECT_FALSE(odometry.tracks());
}

TEST(OdometryChain, NeedsNoRecordedOdometry) {
  OdometryChain odometry = chain(true, false);
  odometry.observe(cloud(kStart, somePoints()));
  EXPECT_TRUE(odometry.ready(kStart));
  FilteredScan scan = hallSeenFrom(planarPose(0, 0, 0), 1);
  EXPECT_TRUE(odometry.track(kStart, scan).isApprox(Pose3::Identity()));
  EXPECT_TRUE(odometry.covers(kStart));
}

TEST(OdometryChain, OdometryThatComesLateDoesNotBendTheMapOfARobotThatSwings) {
  OdometryChain odometry = chain(true, true);
  const auto yaw_at = [](double t) { return 0.8 * std::sin(3 * t); };
  constexpr double kLate = 0.05;
  double worst = 0;
  int next = 0;
  for (int k = 0; k <= 60; ++k) {
    const double t = 0.2 * k;
    for (; 0.02 * next <= t + 1; ++next)
      odometry.observe(wheels(kStart + 0.02 * next, 0, 0, yaw_at(0.02 * next - kLate)));
    ASSERT_TRUE(odometry.ready(kStart + t));
    FilteredScan scan = hallSeenFrom(planarPose(0, 0, yaw_at(t)), static_cast<unsigned>(k));
    worst = std::max(worst, std::abs(yawOf(odometry.track(kStart + t, scan)) - yaw_at(t)));
  }
  EXPECT_LT(worst, 0.01) << "the wheels are up to 0.12 off";
  EXPECT_TRUE(odometry.warnings().empty());
}

TEST(OdometryChain, KeyedScansFollowTheOdometryThatKeyedThem) {
  OdometryChain odometry = chain(true, true, true);
  odometry.observe(wheels(kStart, 0));
  EXPECT_TRUE(odometry.ready(kStart));
  EXPECT_FALSE(odometry.tracks());

  OdometryChain without = chain(true, true, true);
  without.observe(cloud(kStart, somePoints()));
  without.observe(cloud(kStart + 60, somePoints()));
  EXPECT_TRUE(without.ready(kStart));
  EXPECT_TRUE(without.tracks()) << "there is none";
}

TEST(OdometryChain, AtTheEndDecidesByWhatThereIs) {
  OdometryChain odometry = chain(true, true);
  odometry.observe(cloud(kStart, somePoints()));
  odometry.finish();
  EXPECT_TRUE(odometry.tracks());
}

}  // namespace
}  // namespace lamp
