#include "lamp/frontend/LidarOdometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "TestHall.h"
#include "TestObservations.h"

namespace lamp {
namespace {

using namespace test;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kStep = 0.1;  ///< seconds between scans

/** At 1 m/s and 0.1 rad/s on a circle in the hall. */
Pose3 onCircle(double t) {
  const double angle = t / 10;
  return planarPose(10 * std::sin(angle), 10 - 10 * std::cos(angle), angle);
}

MotionPrior priorOf(const Pose3& motion, double sigma_m, double sigma_rad) {
  MotionPrior prior;
  prior.motion = motion;
  Vector6d variances;
  variances.head<3>().setConstant(sigma_m * sigma_m);
  variances.tail<3>().setConstant(sigma_rad * sigma_rad);
  prior.covariance = variances.asDiagonal();
  return prior;
}

/** Drives on the circle. \param prior for the motion to the scan at a time, from the true one.
 * \return the distance from the truth at the end, metres. */
template <class Prior>
double errorAfter(LidarOdometry& odometry, double seconds, Prior prior) {
  Pose3 pose, previous = onCircle(0);
  for (int i = 0; i * kStep <= seconds; ++i) {
    const double t = i * kStep;
    const Pose3 truth = onCircle(t);
    FilteredScan scan = hallSeenFrom(truth, static_cast<unsigned>(i));
    pose = odometry.track(kStart + t, {prior(t, Pose3(previous.inverse() * truth)), {}}, scan);
    previous = truth;
  }
  return (onCircle(0) * pose.translation() - previous.translation()).norm();
}

const auto kNoPrior = [](double, const Pose3&) { return std::optional<MotionPrior>(); };

TEST(LidarOdometry, NeedsNoOtherSource) {
  LidarOdometry odometry;
  EXPECT_LT(errorAfter(odometry, 20, kNoPrior), 0.05);
  EXPECT_THAT(odometry.warnings(), IsEmpty());
  EXPECT_FALSE(odometry.planar());
}

TEST(LidarOdometry, IsNotMisledByWheelsThatSlip) {
  LidarOdometry odometry;
  const double error = errorAfter(odometry, 20, [](double, Pose3 motion) {
    motion.translation() *= 1.3;
    return std::optional<MotionPrior>(priorOf(motion, 0.002, 0.001));
  });
  EXPECT_LT(error, 0.1) << "wheels alone end 6 m off";
}

TEST(LidarOdometry, SaysThatWheelsStandWhileTheLidarMoves) {
  LidarOdometry odometry;
  const double error = errorAfter(odometry, 20, [](double t, const Pose3& motion) {
    return std::optional<MotionPrior>(priorOf(t > 8 ? Pose3::Identity() : motion, 1e-4, 1e-4));
  });
  EXPECT_LT(error, 0.1);
  EXPECT_THAT(odometry.warnings(), Contains(HasSubstr("contradicts the recorded odometry")));
}

TEST(LidarOdometry, SurvivesOdometryThatTeleports) {
  LidarOdometry odometry;
  const double error = errorAfter(odometry, 12, [](double t, Pose3 motion) {
    if (std::abs(t - 6) < 1e-9) motion.translation().x() += 5;
    return std::optional<MotionPrior>(priorOf(motion, 0.002, 0.001));
  });
  EXPECT_LT(error, 0.05);
  EXPECT_THAT(odometry.warnings(), Contains(HasSubstr("in 1 of")));
}

TEST(LidarOdometry, FollowsTheOtherSourceWhereTheLidarSeesNothing) {
  LidarOdometry odometry;
  Pose3 pose;
  for (int i = 0; i <= 50; ++i) {
    FilteredScan scan = hallSeenFrom(onCircle(i * kStep), static_cast<unsigned>(i));
    if (i > 20 && i < 40) scan.points.resize(3);
    const auto prior =
        priorOf(onCircle((i - 1) * kStep).inverse() * onCircle(i * kStep), 0.002, 0.001);
    pose =
        odometry.track(kStart + i * kStep, {i > 0 ? std::optional(prior) : std::nullopt, {}}, scan);
  }
  EXPECT_LT((pose.translation() - (onCircle(0).inverse() * onCircle(5)).translation()).norm(),
            0.02);
  EXPECT_THAT(odometry.warnings(), Contains(HasSubstr("19 of 51 scans could not be registered")));
}

/** The hall from a place along x, with little in it that tells where along. */
FilteredScan bareHallSeenFrom(double x, unsigned seed) {
  FilteredScan scan = hallSeenFrom(planarPose(x, 0, 0), seed);
  std::vector<Eigen::Vector3f> kept;
  for (size_t i = 0; i < scan.points.size(); ++i) {
    const Eigen::Vector3f& p = scan.points[i];
    const float off = std::min({std::abs(p.z()), std::abs(p.y() + 7), std::abs(p.y() - 27)});
    if (off < 0.1f || i % 9 < 3) kept.push_back(p);
  }
  scan.points = std::move(kept);
  return scan;
}

TEST(LidarOdometry, LooksFartherWhereAScanMatchesMuchLessThanScansUsuallyDo) {
  LidarOdometry odometry;
  Pose3 pose;
  for (int i = 0; i <= 10; ++i) {
    FilteredScan scan = bareHallSeenFrom(i < 10 ? 0 : 1.2, static_cast<unsigned>(i));
    pose = odometry.track(kStart + 0.5 * i, {}, scan);
  }
  EXPECT_NEAR(pose.translation().x(), 1.2, 0.05)
      << "the floor and the walls along the hall, more than half of the scan, match at 0 as well";
  EXPECT_THAT(odometry.warnings(), IsEmpty());
}

/** A smooth tunnel along x, seen from a place in it. */
FilteredScan tunnelSeenFrom(double x, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::normal_distribution<float> noise(0, 0.01f);
  FilteredScan scan;
  for (int i = 0; i < 2500; ++i) {
    const float along = 12 * unit(random) + static_cast<float>(x), across = unit(random);
    Eigen::Vector3f p;
    if (i % 4 == 0) p = {along, 2 * across, 0};
    if (i % 4 == 1) p = {along, 2 * across, 3};
    if (i % 4 == 2) p = {along, -2, 1.5f + 1.5f * across};
    if (i % 4 == 3) p = {along, 2, 1.5f + 1.5f * across};
    scan.points.push_back(p + Eigen::Vector3f(noise(random), noise(random), noise(random)) -
                          Eigen::Vector3f(static_cast<float>(x), 0, 0));
  }
  scan.origin = {0, 0, 1};
  return scan;
}

TEST(LidarOdometry, TakesTheMotionAlongATunnelFromWheelsAndSaysHowUncertainItIs) {
  LidarOdometry odometry;
  Pose3 pose;
  FilteredScan first = tunnelSeenFrom(0, 0);
  odometry.track(kStart, {}, first);
  odometry.keepFrom(kStart);
  for (int i = 1; i <= 40; ++i) {
    Pose3 motion = planarPose(0.1, 0, 0.002);  // the gyro drifts
    FilteredScan scan = tunnelSeenFrom(0.1 * i, static_cast<unsigned>(i));
    pose = odometry.track(kStart + i * kStep, {priorOf(motion, 0.01, 0.003), {}}, scan);
  }
  EXPECT_NEAR(pose.translation().x(), 4, 0.02) << "by the wheels";
  EXPECT_NEAR(pose.translation().y(), 0, 0.02) << "by the walls";
  EXPECT_LT(std::abs(yawOf(pose)), 0.005) << "by the walls";
  const auto covariance = odometry.covarianceBetween(kStart, kStart + 40 * kStep);
  ASSERT_TRUE(covariance);
  EXPECT_TRUE(isCovariance(*covariance));
  const double along = std::sqrt((*covariance)(0, 0));
  EXPECT_GT(along, 0.8 * 0.01 * std::sqrt(40));
  EXPECT_LT(along, 2.5 * 0.01 * std::sqrt(40));
  EXPECT_LT(std::sqrt((*covariance)(1, 1)), 0.03);
}

/** The hall as a lidar sees it that takes 0.1 s to turn while the robot turns on the spot. */
FilteredScan sweep(double yaw, double rate, unsigned seed) {
  FilteredScan scan = hallSeenFrom(planarPose(0, 0, yaw), seed);
  for (Eigen::Vector3f& point : scan.points) {
    const double azimuth = std::atan2(point.y(), point.x()) / (2 * M_PI) + 0.5;
    const double time = kStep * azimuth;
    scan.time.push_back(static_cast<float>(time));
    // In the frame of the robot that has turned on until then, as if it stood.
    point = (planarPose(0, 0, rate * time).inverse() * point.cast<double>()).cast<float>();
  }
  return scan;
}

TEST(LidarOdometry, UndistortsSweepsByTheMotionThatItFinds) {
  LidarOdometry odometry;
  const double rate = 1.0;
  double yaw = 0, last_yaw = 0;
  FilteredScan scan;
  for (int i = 0; i <= 40; ++i) {
    const double turning = i < 5 ? 0 : rate;  // sets off at once
    scan = sweep(yaw, turning, static_cast<unsigned>(i));
    const Pose3 pose = odometry.track(kStart + i * kStep, {}, scan);
    EXPECT_NEAR(yawOf(pose.inverse() * planarPose(0, 0, yaw)), 0, i < 10 ? 0.06 : 0.02) << i;
    last_yaw = std::exchange(yaw, yaw + turning * kStep);
  }
  const FilteredScan rigid = hallSeenFrom(planarPose(0, 0, last_yaw), 40);
  ASSERT_EQ(scan.points.size(), rigid.points.size());
  double worst = 0;
  for (size_t i = 0; i < rigid.points.size(); ++i)
    worst = std::max<double>(worst, (scan.points[i] - rigid.points[i]).norm());
  EXPECT_THAT(odometry.warnings(), IsEmpty());
  EXPECT_LT(worst, 0.5) << "of 2.5 m at 25 m without undistorting";
}

/** A sweep of 1 s, as a mount that swings the lidar makes it, while the robot turns to and fro.
 * \param turn_at yaw after a time, rad. */
FilteredScan longSweep(double begin, const std::function<double(double)>& yaw_at, unsigned seed) {
  FilteredScan scan = hallSeenFrom(planarPose(0, 0, yaw_at(begin)), seed);
  for (Eigen::Vector3f& point : scan.points) {
    const double time = std::atan2(point.y(), point.x()) / (2 * M_PI) + 0.5;
    scan.time.push_back(static_cast<float>(time));
    const Pose3 then = planarPose(0, 0, yaw_at(begin + time) - yaw_at(begin));
    // As it was measured, and put by gyros: their error of 2 % remains.
    const Pose3 gyros = planarPose(0, 0, 1.02 * (yaw_at(begin + time) - yaw_at(begin)));
    point = (gyros * then.inverse() * point.cast<double>()).cast<float>();
  }
  return scan;
}

TEST(LidarOdometry, TakesTheRotationWithinLongSweepsFromGyros) {
  LidarOdometry odometry;
  const auto yaw_at = [](double t) { return t < 3 ? 0 : 0.6 * std::sin(t - 3); };
  for (int i = 0; i <= 15; ++i) {
    FilteredScan scan = longSweep(i, yaw_at, static_cast<unsigned>(i));
    const double turned = i > 0 ? 1.02 * (yaw_at(i) - yaw_at(i - 1)) : 0;
    const MeasuredRotation turn{planarPose(0, 0, turned).linear(), 0.01};
    const Pose3 pose = odometry.track(kStart + i, {std::nullopt, turn}, scan);
    EXPECT_NEAR(yawOf(pose.inverse() * planarPose(0, 0, yaw_at(i))), 0, 0.02) << i;
  }
  EXPECT_THAT(odometry.warnings(), IsEmpty());
}

TEST(LidarOdometry, DoesNotFollowGyrosThatAreMountedUpsideDown) {
  LidarOdometry odometry;
  Pose3 pose, previous = onCircle(0);
  for (int i = 0; i <= 100; ++i) {
    const Pose3 truth = onCircle(4 * i * kStep);  // 0.4 rad/s
    FilteredScan scan = hallSeenFrom(truth, static_cast<unsigned>(i));
    const MeasuredRotation turn{(truth.inverse() * previous).linear(), 0.001};
    pose = odometry.track(kStart + i * kStep, {std::nullopt, turn}, scan);
    if (i > 0) {
      ASSERT_TRUE(odometry.seenOrientation());
      EXPECT_LT(
          (odometry.seenOrientation()->rotation - (onCircle(0).inverse() * truth).linear()).norm(),
          0.02);
    }
    previous = truth;
  }
  EXPECT_LT((onCircle(0) * pose.translation() - previous.translation()).norm(), 0.1);
}

TEST(LidarOdometry, MapsALevelLaserInThePlane) {
  LidarOdometry odometry;
  Pose3 pose;
  for (int i = 0; i <= 60; ++i) {
    FilteredScan scan;
    for (const Eigen::Vector3f& point :
         hallSeenFrom(onCircle(i * kStep), static_cast<unsigned>(i)).points)
      if (point.z() > 0.2f) scan.points.emplace_back(point.x(), point.y(), 1.0f);
    scan.planar = true;
    pose = odometry.track(kStart + i * kStep, {}, scan);
  }
  EXPECT_TRUE(odometry.planar());
  EXPECT_LT((pose.translation() - (onCircle(0).inverse() * onCircle(6)).translation()).norm(),
            0.05);
  EXPECT_EQ(pose.translation().z(), 0);
}

TEST(LidarOdometry, StandingStillAddsNothing) {
  LidarOdometry odometry;
  Pose3 pose;
  for (int i = 0; i <= 600; ++i) {
    FilteredScan scan = hallSeenFrom(onCircle(0), static_cast<unsigned>(i % 20));
    pose = odometry.track(kStart + i * kStep, {}, scan);
  }
  EXPECT_LT(pose.translation().norm(), 0.05);
  EXPECT_LT(rotationAngle(pose), 0.005);
}

TEST(LidarOdometry, TakesEmptyScans) {
  LidarOdometry odometry;
  FilteredScan nothing;
  EXPECT_TRUE(odometry.track(kStart, {}, nothing).isApprox(Pose3::Identity()));
  FilteredScan scan = hallSeenFrom(onCircle(0), 1);
  odometry.track(kStart + 1, {}, scan);
  EXPECT_TRUE(isFinite(odometry.track(kStart + 2, {}, nothing)));
}

TEST(LidarOdometry, ALidarThatAlwaysSeesTooLittleLeavesTheMotionToTheOtherSource) {
  LidarOdometry odometry;
  Pose3 pose;
  for (int i = 0; i <= 20; ++i) {
    FilteredScan scan = hallSeenFrom(onCircle(0), 1);
    scan.points.resize(30);
    pose = odometry.track(kStart + i * kStep, {priorOf(planarPose(0.2, 0, 0), 0.002, 0.001), {}},
                          scan);
  }
  EXPECT_NEAR(pose.translation().x(), 4, 1e-6);
  EXPECT_THAT(odometry.warnings(), Contains(HasSubstr("20 of 21 scans could not be registered")));
}

}  // namespace
}  // namespace lamp
