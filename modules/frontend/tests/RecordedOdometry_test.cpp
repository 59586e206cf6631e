#include "lamp/frontend/RecordedOdometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "TestObservations.h"

namespace lamp {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

double distance(const Pose3& a, const Pose3& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

TEST(RecordedOdometry, KnowsNothingAtFirst) {
  RecordedOdometry odometry;
  EXPECT_FALSE(odometry.covers(0));
  EXPECT_FALSE(odometry.covers(kStart));
  EXPECT_THAT(odometry.warnings(), IsEmpty());
  odometry.observe(cloud(kStart, somePoints()));
  EXPECT_FALSE(odometry.covers(0)) << "a lidar is no odometry";
}

TEST(RecordedOdometry, InterpolatesWithAConstantTwist) {
  const Vector6d twist = tangent(1.0, 0.2, -0.1, 0.1, 0.05, 0.4);
  RecordedOdometry odometry;
  for (int i = 0; i <= 4; ++i) odometry.observe(robotPose(kStart + i, expSE3(i * twist)));
  for (const double t : {0.0, 0.25, 1.0, 1.7, 3.999, 4.0})
    EXPECT_LT(distance(odometry.poseAt(kStart + t), expSE3(t * twist)), 1e-6) << t;
}

TEST(RecordedOdometry, HoldsThePoseBeyondItsEnds) {
  RecordedOdometry odometry;
  odometry.observe(wheels(kStart + 1, 1.0));
  odometry.observe(wheels(kStart + 2, 3.0));
  EXPECT_LT(distance(odometry.poseAt(kStart - 5), planarPose(1, 0, 0)), 1e-12);
  EXPECT_LT(distance(odometry.poseAt(kStart + 9), planarPose(3, 0, 0)), 1e-12);
  EXPECT_TRUE(odometry.covers(kStart + 2));
  EXPECT_FALSE(odometry.covers(kStart + 2.001));
}

TEST(RecordedOdometry, IsPlanarAsLongAsTheRobotStaysInThePlane) {
  RecordedOdometry odometry;
  odometry.observe(wheels(kStart, 0));
  odometry.observe(wheels(kStart + 1, 1, 0.5, 0.7));
  EXPECT_TRUE(odometry.planar());
  const Pose3 between = odometry.poseAt(kStart + 0.4);
  EXPECT_EQ(between.matrix(), projectToPlane(between).matrix()) << "not even rounding lifts it";
  odometry.observe(robotPose(kStart + 2, expSE3(tangent(1, 1, 0.02, 0.01, 0, 1))));
  EXPECT_TRUE(odometry.planar()) << "so much is noise";
  odometry.observe(robotPose(kStart + 3, expSE3(tangent(1.5, 1, 0, 0.1, 0, 1))));
  EXPECT_FALSE(odometry.planar()) << "on a slope";
}

TEST(RecordedOdometry, IsNotPlanarOnARamp) {
  RecordedOdometry odometry;
  for (int i = 0; i < 20; ++i)
    odometry.observe(robotPose(kStart + i, expSE3(tangent(i, 0, 0.04 * i, 0, 0, 0))));
  EXPECT_FALSE(odometry.planar());
}

/** Ten readings a second of a robot that drives at 1 m/s along x. */
class DriveAlongX : public testing::Test {
 protected:
  void drive(double begin, double end, const Pose3& recorded_T_odom = Pose3::Identity()) {
    for (int i = 0; begin + 0.1 * i < end - 0.01; ++i) {
      const double t = begin + 0.1 * i;
      odometry_.observe(robotPose(kStart + t, recorded_T_odom * planarPose(t, 0, 0)));
    }
  }
  double xAt(double t) { return odometry_.poseAt(kStart + t).translation().x(); }

  RecordedOdometry odometry_;
};

TEST_F(DriveAlongX, GoesOnWhereOdometryBeginsAnew) {
  drive(0, 20);
  drive(20, 40, planarPose(20, 0, 0).inverse());  // counts from the origin again
  EXPECT_NEAR(xAt(19.95), 19.95, 0.02);
  EXPECT_NEAR(xAt(30), 30, 0.02) << "at the speed that it had";
  EXPECT_TRUE(odometry_.doubtBetween(kStart + 10, kStart + 19).isZero());
  const Matrix6d doubt = odometry_.doubtBetween(kStart + 19, kStart + 21);
  EXPECT_GT(std::sqrt(doubt(0, 0)), 0.05);
  EXPECT_LT(std::sqrt(doubt(0, 0)), 0.5);
  EXPECT_FALSE(odometry_.covarianceBetween(kStart + 19, kStart + 21));
  EXPECT_THAT(odometry_.warnings(), ElementsAre(HasSubstr("begins anew 1 times")));
}

TEST_F(DriveAlongX, NoticesARestartNearTheOrigin) {
  drive(0, 0.8);
  drive(0.8, 5, planarPose(0.8, 0, 0).inverse());
  EXPECT_NEAR(xAt(4), 4, 0.02);
  EXPECT_THAT(odometry_.warnings(), ElementsAre(HasSubstr("begins anew")));
}

TEST_F(DriveAlongX, NoticesAJumpToAnywhere) {
  drive(0, 20);
  drive(20, 40, planarPose(3, 40, 2));
  EXPECT_NEAR((odometry_.poseAt(kStart + 30).translation() - Eigen::Vector3d(30, 0, 0)).norm(), 0,
              0.05);
  EXPECT_THAT(odometry_.warnings(), ElementsAre(HasSubstr("begins anew")));
}

TEST_F(DriveAlongX, LeavesOutOneReadingThatIsAstray) {
  for (const Pose3& wrong : {planarPose(25, 0, 0), planarPose(0, 0, 0), planarPose(20, 1, 3)}) {
    odometry_ = RecordedOdometry();
    drive(0, 20);
    odometry_.observe(robotPose(kStart + 20, wrong));
    EXPECT_FALSE(odometry_.covers(kStart + 20)) << "the next one tells";
    drive(20.1, 25);
    for (const double t : {19.95, 20.0, 20.05, 22.0}) EXPECT_NEAR(xAt(t), t, 0.02);
    EXPECT_THAT(odometry_.warnings(), ElementsAre(HasSubstr("1 odometry readings were dropped")));
  }
}

TEST_F(DriveAlongX, KnowsNothingWithinAGap) {
  drive(0, 20);
  drive(40, 50);
  for (const double t : {-0.4, 10.0, 20.3, 39.7, 45.0}) EXPECT_TRUE(odometry_.knows(kStart + t));
  for (const double t : {-0.6, 21.0, 30.0, 39.0}) EXPECT_FALSE(odometry_.knows(kStart + t)) << t;
}

TEST(RecordedOdometry, ARobotThatStandsLeavesNoGap) {
  RecordedOdometry odometry;
  for (const double t : {0, 1, 2, 3, 4, 5, 6, 60, 61})
    odometry.observe(wheels(kStart + t, std::min(t, 6.0)));
  EXPECT_TRUE(odometry.knows(kStart + 30));
  EXPECT_THAT(odometry.warnings(), IsEmpty());
}

TEST(RecordedOdometry, SpeedsUpAndTurnsWithoutAWarning) {
  RecordedOdometry odometry;
  double x = 0, yaw = 0;
  for (int i = 0; i < 400;
       ++i) {  // a car: 4 m/s² up to 20 m/s, hard braking; then turning in place
    const double t = 0.1 * i;
    const double speed = t < 5    ? 0
                         : t < 10 ? 4 * (t - 5)
                         : t < 20 ? 20
                                  : std::max(0.0, 220 - 10 * t);
    x += 0.1 * speed;
    yaw += t > 30 ? 0.1 * 1.5 : 0;
    odometry.observe(wheels(kStart + t, x, 0, yaw));
  }
  EXPECT_THAT(odometry.warnings(), IsEmpty());
}

TEST(RecordedOdometry, DropsReadingsWhoseStampsDoNotIncrease) {
  RecordedOdometry odometry;
  odometry.observe(wheels(kStart, 0));
  odometry.observe(wheels(kStart + 2, 2));
  odometry.observe(wheels(kStart + 1, 77));
  odometry.observe(wheels(kStart + 2, 88));
  odometry.observe(wheels(kStart + 3, 3));
  EXPECT_NEAR(odometry.poseAt(kStart + 1).translation().x(), 1.0, 1e-6);
  EXPECT_NEAR(odometry.poseAt(kStart + 2.5).translation().x(), 2.5, 1e-6);
  EXPECT_THAT(odometry.warnings(), ElementsAre(HasSubstr("2 odometry readings were dropped")));
}

TEST(RecordedOdometry, IgnoresPosesThatAreNoNumbers) {
  RecordedOdometry odometry;
  odometry.observe(wheels(kStart, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(odometry.covers(0));
}

/** A drive with a covariance that grows from reading to reading, as dead reckoning's does. */
class GrowingCovariance : public testing::Test {
 protected:
  GrowingCovariance() {
    Vector6d sigmas;
    sigmas << 0.02, 0.01, 0.01, 0.001, 0.002, 0.004;
    step_covariance_ = sigmas.cwiseAbs2().asDiagonal();
    step_covariance_(0, 5) = step_covariance_(5, 0) = 2e-5;
  }

  /** Pose and covariance after so many steps from rest at the origin. */
  void simulate(int steps, const Matrix6d& start, Pose3& pose, Matrix6d& covariance) const {
    pose = Pose3::Identity();
    covariance = start;
    for (int i = 0; i < steps; ++i) {
      pose = pose * motion_;
      covariance = composeCovariance(covariance, motion_, step_covariance_);
    }
  }

  void record(int readings) {
    for (int i = 0; i < readings; ++i) {
      Pose3 pose;
      Matrix6d covariance;
      simulate(i, 1e-4 * Matrix6d::Identity(), pose, covariance);
      odometry_.observe(robotPose(kStart + i, pose, covariance));
    }
  }

  const Pose3 motion_ = expSE3(tangent(0.5, 0.05, 0.02, 0.02, -0.01, 0.1));
  Matrix6d step_covariance_;
  RecordedOdometry odometry_;
};

TEST_F(GrowingCovariance, GivesTheCovarianceOfTheMotion) {
  record(15);
  for (const int begin : {2, 6}) {
    const auto between = odometry_.covarianceBetween(kStart + begin, kStart + begin + 4);
    ASSERT_TRUE(between);
    Pose3 pose;
    Matrix6d expected;
    simulate(4, Matrix6d::Zero(), pose, expected);
    EXPECT_LT((*between - expected).norm(), 1e-5 * expected.norm()) << begin;
    EXPECT_TRUE(isCovariance(*between));
  }
  EXPECT_THAT(odometry_.warnings(), IsEmpty());
}

TEST_F(GrowingCovariance, IsNoneWithoutMotionOfTime) {
  record(3);
  EXPECT_FALSE(odometry_.covarianceBetween(kStart + 1, kStart + 1));
  EXPECT_FALSE(odometry_.covarianceBetween(kStart + 5, kStart + 9));
}

TEST_F(GrowingCovariance, StandingStillAtTheEndIsNoReasonToWarn) {
  record(6);
  Pose3 pose;
  Matrix6d covariance;
  simulate(5, 1e-4 * Matrix6d::Identity(), pose, covariance);
  for (int i = 6; i < 9; ++i) odometry_.observe(robotPose(kStart + i, pose, covariance));
  EXPECT_TRUE(odometry_.covarianceBetween(kStart, kStart + 5));
  EXPECT_THAT(odometry_.warnings(), IsEmpty());
}

TEST(RecordedOdometry, IgnoresAConstantCovarianceAndSaysSo) {
  for (const double turn : {0.0, 0.3}) {
    RecordedOdometry odometry;
    Pose3 pose = Pose3::Identity();
    for (int i = 0; i < 6; ++i) {
      odometry.observe(robotPose(kStart + i, pose, 0.01 * Matrix6d::Identity()));
      pose = pose * planarPose(1, 0, turn);
    }
    EXPECT_FALSE(odometry.covarianceBetween(kStart, kStart + 3)) << turn;
    EXPECT_THAT(odometry.warnings(), ElementsAre(HasSubstr("covariance"))) << turn;
  }
}

TEST(RecordedOdometry, HasNoCovarianceWhereNoneIsRecorded) {
  RecordedOdometry odometry;
  for (int i = 0; i < 4; ++i) odometry.observe(robotPose(kStart + i, planarPose(i, 0, 0)));
  EXPECT_FALSE(odometry.covarianceBetween(kStart, kStart + 3));
  EXPECT_THAT(odometry.warnings(), IsEmpty());
}

TEST(RecordedOdometry, ForgetsOnlyWhatIsNotAskedForAgain) {
  RecordedOdometry odometry;
  for (int i = 0; i <= 20; ++i) odometry.observe(wheels(kStart + i, i));
  for (const double t : {10.5, 11.25, 20.0})
    EXPECT_NEAR(odometry.poseAt(kStart + t).translation().x(), t, 1e-6);
}

TEST_F(GrowingCovariance, KeepsTheBeginningOfAnEdgeHoweverLongItLasts) {
  record(3);
  odometry_.keepFrom(kStart + 2);
  Pose3 pose;
  Matrix6d covariance;
  simulate(2, 1e-4 * Matrix6d::Identity(), pose, covariance);
  for (int i = 3; i < 500; ++i) odometry_.observe(robotPose(kStart + i, pose, covariance));
  EXPECT_LT(odometry_.readingsHeld(), 100u) << "a robot that waits costs no memory";
  simulate(3, 1e-4 * Matrix6d::Identity(), pose, covariance);
  odometry_.observe(robotPose(kStart + 500, pose, covariance));
  const auto between = odometry_.covarianceBetween(kStart + 2, kStart + 500);
  ASSERT_TRUE(between);
  EXPECT_LT((*between - step_covariance_).norm(), 1e-5 * step_covariance_.norm());
}

TEST(RecordedOdometry, IsMadeByName) {
  registerAllClasses_lamp_core();
  registerAllClasses_lamp_frontend();
  EXPECT_THAT(stageClasses(CLASS_ID(OdometrySource)),
              ElementsAre("LidarOdometry", "RecordedOdometry"));
}

}  // namespace
}  // namespace lamp
