#include "lamp/frontend/SurveyLocalizer.h"

#include <gtest/gtest.h>

#include "TestHall.h"
#include "TestObservations.h"

namespace lamp {
namespace {

using namespace test;

constexpr double kStep = 0.2;  ///< seconds between scans

Matrix6d diagonal(double sigma_m, double sigma_rad) {
  Vector6d variances;
  variances.head<3>().setConstant(sigma_m * sigma_m);
  variances.tail<3>().setConstant(sigma_rad * sigma_rad);
  return variances.asDiagonal();
}

/** At 1 m/s and 0.1 rad/s on a circle in the hall, the lidar 1 m above the floor. */
Pose3 onCircle(double t) {
  const double angle = t / 10;
  Pose3 pose = planarPose(10 * std::sin(angle), 10 - 10 * std::cos(angle), angle);
  pose.translation().z() = 1;
  return pose;
}

LocalMap surveyOf(const std::vector<Eigen::Vector3f>& points) {
  LocalMap survey(0.1, false);
  survey.add(points, Pose3::Identity(), Eigen::Vector3f::Zero(), 0);
  return survey;
}

/** What odometry says of the motion between two moments: 3 % too far, and turned. */
OdometryEdge drifting(double from, double to) {
  Pose3 motion = onCircle(from).inverse() * onCircle(to);
  motion.translation() *= 1.03;
  motion.rotate(Eigen::AngleAxisd(0.002, Eigen::Vector3d::UnitZ()));
  return {motion, diagonal(0.01, 0.003)};
}

double error(const SurveyLocalizer& localizer, const Pose3& truth) {
  return (localizer.pose().translation() - truth.translation()).norm();
}

std::vector<Eigen::Vector3f> scanAt(double t) {
  return hallSeenFrom(onCircle(t), static_cast<unsigned>(100 * t)).points;
}

TEST(SurveyLocalizer, HoldsARobotWhoseOdometryDrifts) {
  LocalMap survey = surveyOf(hall(99, 100000));
  SurveyLocalizer localizer(survey, {onCircle(0), diagonal(0.01, 0.01)});
  ASSERT_TRUE(localizer.correct(scanAt(0)));
  Pose3 by_odometry = onCircle(0);
  for (int i = 1; i <= 30; ++i) {
    const OdometryEdge edge = drifting((i - 1) * kStep, i * kStep);
    by_odometry = by_odometry * edge.previous_T_this;
    localizer.predict(edge);
    ASSERT_TRUE(localizer.correct(scanAt(i * kStep))) << i;
    EXPECT_LT(error(localizer, onCircle(i * kStep)), 0.02) << i;
    EXPECT_LT(rotationAngle(onCircle(i * kStep).inverse() * localizer.pose()), 0.003) << i;
  }
  EXPECT_GT((by_odometry.translation() - onCircle(6).translation()).norm(), 0.2);
  EXPECT_TRUE(localizer.observed());
  EXPECT_GT(localizer.matchedShare(), 0.9);
  EXPECT_LT(localizer.deviation(), 0.02);
}

TEST(SurveyLocalizer, AStartPoseMayBeWorseThanItsCovarianceStates) {
  LocalMap survey = surveyOf(hall(99, 100000));
  const Pose3 wrong = onCircle(0) * expSE3(tangent(0.4, -0.3, 0.1, 0, 0, 0.05));
  SurveyLocalizer localizer(survey, {wrong, diagonal(0.0016, 0.0004)});
  ASSERT_TRUE(localizer.correct(scanAt(0)));
  EXPECT_LT(error(localizer, onCircle(0)), 0.02);
}

TEST(SurveyLocalizer, OutsideTheSurveyThePoseIsThatOfOdometry) {
  auto points = hall(99, 100000);
  points.erase(std::remove_if(points.begin(), points.end(),
                              [](const Eigen::Vector3f& point) { return point.x() > -8; }),
               points.end());
  LocalMap survey = surveyOf(points);
  SurveyLocalizer localizer(survey, {onCircle(0), diagonal(0.01, 0.01)});
  EXPECT_FALSE(localizer.correct(scanAt(0)));
  EXPECT_LT(localizer.matchedShare(), 0.5);
  EXPECT_TRUE(localizer.pose().isApprox(onCircle(0)));
}

TEST(SurveyLocalizer, AScanThatShowsNothingIsNotRegistered) {
  LocalMap survey = surveyOf(hall(99, 100000));
  SurveyLocalizer localizer(survey, {onCircle(0), diagonal(0.01, 0.01)});
  EXPECT_FALSE(localizer.correct({}));
  EXPECT_TRUE(localizer.pose().isApprox(onCircle(0)));
}

/** One scan that contradicts odometry may be wrong; if the next one does too, odometry slipped. */
TEST(SurveyLocalizer, BelievesTheSecondScanAgainstOdometry) {
  LocalMap survey = surveyOf(hall(99, 100000));
  SurveyLocalizer localizer(survey, {onCircle(0), diagonal(0.01, 0.01)});
  ASSERT_TRUE(localizer.correct(scanAt(0)));
  localizer.predict({planarPose(0.5, 0, 0), diagonal(0.002, 0.001)});  // it has not moved
  EXPECT_FALSE(localizer.correct(scanAt(0)));
  localizer.predict({Pose3::Identity(), diagonal(0.002, 0.001)});
  EXPECT_TRUE(localizer.correct(scanAt(0)));
  EXPECT_LT(error(localizer, onCircle(0)), 0.02);
}

TEST(SurveyLocalizer, AlongASmoothTunnelOdometryTells) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(-1, 1);
  const auto tunnel = [&](int count, float reach) {
    std::vector<Eigen::Vector3f> points;
    for (int i = 0; i < count; ++i) {
      const float along = reach * unit(random), across = unit(random);
      if (i % 4 < 2)
        points.emplace_back(along, 2 * across, i % 4 ? 1.5f : -1.5f);
      else
        points.emplace_back(along, i % 4 == 2 ? 2.0f : -2.0f, 1.5f * across);
    }
    return points;
  };
  LocalMap survey = surveyOf(tunnel(150000, 40));
  SurveyLocalizer localizer(survey, {Pose3::Identity(), diagonal(0.01, 0.01)});
  ASSERT_TRUE(localizer.correct(tunnel(3000, 10)));
  for (int i = 0; i < 20; ++i) {
    localizer.predict({planarPose(0.2, 0.02, 0.002), diagonal(0.02, 0.005)});
    ASSERT_TRUE(localizer.correct(tunnel(3000, 10))) << i;
  }
  EXPECT_NEAR(localizer.pose().translation().x(), 4, 0.05) << "by odometry";
  EXPECT_NEAR(localizer.pose().translation().y(), 0, 0.02) << "by the walls";
  EXPECT_LT(std::abs(yawOf(localizer.pose())), 0.005) << "by the walls";
  EXPECT_FALSE(localizer.observed());
}

}  // namespace
}  // namespace lamp
