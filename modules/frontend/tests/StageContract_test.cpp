// What every odometry source must hold to, whoever wrote it.
#include <gtest/gtest.h>

#include <limits>

#include "StageSuite.h"
#include "TestHall.h"
#include "TestObservations.h"
#include "lamp/core/Stage.h"
#include "lamp/frontend/OdometrySource.h"

namespace lamp {
namespace {

using namespace test;

std::vector<std::string> odometrySources() {
  registerAllClasses_lamp_core();
  registerAllClasses_lamp_frontend();
  return stageClasses(CLASS_ID(OdometrySource));
}

constexpr double kEnd = 20.0;  ///< of the drive, seconds

/** Where the recorded robot is: on a circle of 10 m radius, at 1 m/s. */
Pose3 truth(double second) {
  const double angle = second / 10;
  return planarPose(10 * std::sin(angle), 10 - 10 * std::cos(angle), angle);
}

/** A drive with wheels, a tracker's poses, and a lidar; each source takes what it understands. */
void drive(OdometrySource& source, double end = kEnd) {
  for (double t = 0; t <= end; t += 0.1) {
    source.observe(robotPose(kStart + t, truth(t)));
    source.observe(cloud(kStart + t, somePoints()));
    if (auto* const tracker = dynamic_cast<ScanOdometry*>(&source)) {
      FilteredScan scan = hallSeenFrom(truth(t), static_cast<unsigned>(10 * t));
      tracker->track(kStart + t, {}, scan);
    }
  }
}

class AnyOdometrySource : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<OdometrySource> make() const { return makeDefault<OdometrySource>(GetParam()); }
  const std::shared_ptr<OdometrySource> source = make();
};
INSTANTIATE_TEST_SUITE_P(All, AnyOdometrySource, testing::ValuesIn(odometrySources()), testName);

TEST_P(AnyOdometrySource, CoversNothingBeforeItsFirstReading) {
  EXPECT_FALSE(source->covers(kStart));
  EXPECT_TRUE(source->warnings().empty());
}

TEST_P(AnyOdometrySource, FollowsADriveWithoutAFault) {
  drive(*source);
  EXPECT_TRUE(source->covers(kStart + kEnd / 2));
  EXPECT_FALSE(source->covers(kStart + kEnd + 1));
  const Pose3 start = source->poseAt(kStart);
  for (double t = 0; t <= kEnd - 1; t += 0.73) {
    const Pose3 moved = start.inverse() * source->poseAt(kStart + t);
    EXPECT_LT((moved.translation() - truth(t).translation()).norm(), 0.1 + 0.01 * t) << t;
    EXPECT_LT(rotationAngle(moved.inverse() * truth(t)), 0.02) << t;
  }
  EXPECT_TRUE(source->warnings().empty()) << source->warnings().front();
}

TEST_P(AnyOdometrySource, GivesPosesAndCovariancesAtAnyStamp) {
  drive(*source);
  for (double t = -3; t <= kEnd + 3; t += 0.9) {
    const auto covariance = source->covarianceBetween(kStart + t, kStart + t + 2);
    EXPECT_TRUE(!covariance || isCovariance(*covariance)) << t;
    const Pose3 pose = source->poseAt(kStart + t);
    EXPECT_TRUE(isFinite(pose)) << t;
    EXPECT_LT((pose.linear() * pose.linear().transpose() - Eigen::Matrix3d::Identity()).norm(),
              1e-9);
  }
}

TEST_P(AnyOdometrySource, TakesReadingsThatAreNoNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  drive(*source, kEnd / 2);
  source->observe(wheels(kStart + kEnd / 2 + 0.05, nan, nan, nan));
  Pose3 broken = truth(kEnd / 2);
  broken.translation().y() = nan;
  source->observe(robotPose(kStart + kEnd / 2 + 0.06, broken));
  EXPECT_TRUE(isFinite(source->poseAt(kStart + kEnd / 2)));
  EXPECT_TRUE(isFinite(source->poseAt(kStart + kEnd)));
}

TEST_P(AnyOdometrySource, SaysTheSameTwiceAndSharesNothing) {
  const auto other = make(), again = make();
  drive(*source);
  for (int i = 0; i < 5; ++i) other->observe(wheels(kStart + i, 100.0 * i));
  drive(*again);
  EXPECT_EQ(source->planar(), again->planar());
  for (double t = 0; t < kEnd; t += 1.1) {
    const auto one = source->covarianceBetween(kStart + t, kStart + t + 1);
    const auto two = again->covarianceBetween(kStart + t, kStart + t + 1);
    ASSERT_EQ(one.has_value(), two.has_value());
    if (one) {
      EXPECT_EQ(*one, *two);
    }
    EXPECT_EQ(source->poseAt(kStart + t).matrix(), again->poseAt(kStart + t).matrix());
  }
}

}  // namespace
}  // namespace lamp
