#include "OdometryComparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "TestObservations.h"
#include "lamp/frontend/RecordedOdometry.h"

namespace lamp {
namespace {

using namespace test;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/** Where a robot is that drives at 1 m/s through bends. */
Pose3 pose(double t) {
  return planarPose(t, 0, std::sin(0.7 * t));
}

/** A minute, ten scans a second. \param recorded what odometry says at t, if it says anything. */
std::vector<std::string> compare(const std::function<std::optional<Pose3>(double t)>& recorded,
                                 const std::function<Pose3(double t)>& by_lidar = pose) {
  OdometryComparison comparison;
  RecordedOdometry odometry;
  for (int i = 0; i < 600; ++i) {
    const double t = 0.1 * i;
    if (const auto said = recorded(t)) odometry.observe(robotPose(kStart + t, *said));
    comparison.observe({kStart + t, by_lidar(t)}, odometry);
  }
  return comparison.warnings();
}

TEST(OdometryComparison, SaysNothingOfOdometryThatIsRight) {
  EXPECT_THAT(compare(pose), IsEmpty());
}

TEST(OdometryComparison, SaysNothingWhereThereIsNoOdometryAtAll) {
  EXPECT_THAT(compare([](double) { return std::nullopt; }), IsEmpty());
}

TEST(OdometryComparison, SaysForHowLongOdometryIsMissing) {
  const auto gap = [](double t) {
    return t > 20 && t < 26 ? std::nullopt : std::optional(pose(t));
  };
  EXPECT_THAT(compare(gap),
              ElementsAre(AllOf(HasSubstr("says nothing of 5.9"), HasSubstr("1600000020.000"))));
  const auto late = [](double t) { return t < 10 ? std::nullopt : std::optional(pose(t)); };
  EXPECT_THAT(compare(late), ElementsAre(HasSubstr("says nothing of 9.")));
  const auto early = [](double t) { return t > 50 ? std::nullopt : std::optional(pose(t)); };
  EXPECT_THAT(compare(early), ElementsAre(HasSubstr("says nothing of 9.")));
}

TEST(OdometryComparison, SaysThatOdometryStandsWhileTheLidarMoves) {
  EXPECT_THAT(compare([](double t) { return std::optional(pose(std::min(t, 40.0))); }),
              ElementsAre(AllOf(HasSubstr("stands in 19.9 s"), HasSubstr("1600000040.000"))));
}

TEST(OdometryComparison, SaysNothingOfARobotThatStandsOrSlips) {
  const auto pauses = [](double t) { return pose(std::clamp(t, 0.0, 20.0)); };
  EXPECT_THAT(compare([&](double t) { return std::optional(pauses(t)); }, pauses), IsEmpty());
  const auto slips = [](double t) { return pose(t < 20 ? t : 20 + 0.3 * (t - 20)); };
  EXPECT_THAT(compare(pose, slips), IsEmpty());
}

TEST(OdometryComparison, SaysThatClocksDiffer) {
  EXPECT_THAT(compare([](double t) { return std::optional(pose(t - 0.5)); }),
              ElementsAre(HasSubstr("0.50 s later in the odometry")));
  EXPECT_THAT(compare([](double t) { return std::optional(pose(t + 0.3)); }),
              ElementsAre(HasSubstr("0.30 s earlier in the odometry")));
}

}  // namespace
}  // namespace lamp
