#include "lamp/frontend/RecordedOdometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(RecordedOdometry, IsPlanarWithWheelsOnly) {
  RecordedOdometry odometry;
  odometry.observe(wheels(kStart, 0));
  odometry.observe(wheels(kStart + 1, 1, 0.5, 0.7));
  EXPECT_TRUE(odometry.planar());
  const Pose3 between = odometry.poseAt(kStart + 0.4);
  EXPECT_EQ(between.matrix(), projectToPlane(between).matrix()) << "not even rounding lifts it";
  odometry.observe(robotPose(kStart + 2, Pose3::Identity()));
  EXPECT_FALSE(odometry.planar());
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
  odometry.covarianceBetween(kStart + 10.5, kStart + 15);
  for (const double t : {10.5, 11.25, 20.0})
    EXPECT_NEAR(odometry.poseAt(kStart + t).translation().x(), t, 1e-6);
}

TEST(RecordedOdometry, IsMadeByName) {
  registerAllClasses_lamp_core();
  registerAllClasses_lamp_frontend();
  EXPECT_THAT(stageClasses(CLASS_ID(OdometrySource)), ElementsAre("RecordedOdometry"));
}

}  // namespace
}  // namespace lamp
